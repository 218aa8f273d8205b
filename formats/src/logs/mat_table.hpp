// The vectors of a MATLAB file (.mat v5 to v7.3) as lines of text, by matio. In a build without it (BALLBAR_MAT=OFF)
// reading throws an Error that says what to install.
#pragma once

#include <string>
#include <string_view>

#include "logs/log_sources.hpp"

namespace ballbar {

bool is_mat_file(std::string_view head);  // by its first bytes

// Vectors and matrices of numbers, also those in structs, of the length that most of them have; a matrix is a column
// each, named by a cell array of as many texts where there is one. The file is read in a process of its own: what is
// damaged cannot take this one along. Throws Error.
TableText mat_table(std::string_view bytes, const std::string& name);

}  // namespace ballbar
