// Why effects are not testable on data, in words.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

std::string_view name_of(Testability testability);

// A phrase of an effect that is not testable: "no column for speed (rpm)".
Paragraph reason_of(const Detectability& untestable);

// Effects of these kinds by why they are not testable: the first of each reason, with the names of all of the reason,
// in their order.
std::vector<std::pair<const Detectability*, std::vector<std::string>>> by_reason(const std::vector<Detectability>& all,
                                                                                 bool (*is_meant)(Testability));

}  // namespace ballbar
