// A verdict in plain words.
#pragma once

#include <string>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"

namespace ballbar {

std::string sentence_of(const Diagnosis& diagnosis);

}  // namespace ballbar
