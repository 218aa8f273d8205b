// Values as JSON text, for files whose lines are laid out by hand.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ballbar {

// A file name need not be UTF-8: what is not becomes U+FFFD.
std::string json_text(const std::string& text);

// Reads back to the same double. Throws Error where it is not finite.
std::string json_text(double number);

std::string json_text(const std::vector<std::string>& texts);
std::string json_text(const Eigen::Ref<const Eigen::VectorXd>& numbers);

}  // namespace ballbar
