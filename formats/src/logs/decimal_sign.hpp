// The decimal sign of a log.
#pragma once

#include <string>

#include "logs/log_shape.hpp"

namespace ballbar {

// By what the cells of the first rows say: "0,125" and "1.234,5" are sure, "1,234" alone is not. Sets shape.decimal.
// Throws Error with name:line where both are possible.
void find_decimal(const std::string& name, const LogRecipe& recipe, LogShape& shape);

}  // namespace ballbar
