// Pictures by gnuplot, run as a process of its own: no shell, none of the user's settings.
#pragma once

#include <string>
#include <string_view>

namespace ballbar {

// What gnuplot writes to its standard output for a script that sets the terminal svg. The same script gives the
// same bytes. Throws Error: no gnuplot on PATH, gnuplot fails, its output is not a whole SVG.
std::string svg_by_gnuplot(const std::string& script);

// Any text as a string of a gnuplot script of which nothing is run or replaced; the terminal must be set with
// `noenhanced`. ASCII signs are written as octal escapes, so that the script holds no quote, backtick or backslash of
// the text: within single quotes, gnuplot 5.4 takes a doubled quote at the start of a text for the end of the string.
// What an SVG cannot hold becomes a space (control characters, line breaks) or U+FFFD (bytes that are not UTF-8, code
// points XML leaves out).
std::string gnuplot_quoted(std::string_view text);

}  // namespace ballbar
