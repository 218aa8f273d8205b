// Checks of option values, before any file is read. A failure is an error in the command line: exit status 2.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/recordings/recording_file.hpp"

namespace ballbar {

inline constexpr double kLargestSeed = 9.2e18;  // a whole number of 63 bits

// Of the whole text; nothing where it is none.
std::optional<double> finite_number(std::string_view text);

// A finite number, both ends included.
CLI::Validator number_within(double low, double high);
CLI::Validator whole_number_within(double low, double high);

// `or_infinite`: inf too.
CLI::Validator number_above_0(bool or_infinite = false);

// NAME=NUMBER, finite.
CLI::Validator name_and_number();

// A name of a file with one of these endings, such as ".csv".
CLI::Validator name_that_ends_in(std::vector<std::string> endings);

// Of 3840, 3840s, 64min or 1.5h; nothing where it is none of the kind.
std::optional<double> time_s_of(std::string text);

// Shown as TIME: of that kind, which becomes a number of seconds. `above_0`: of no other kind.
void take_time(CLI::Option& option, bool above_0);

// --radius: 100, 100mm or 0.1m, which becomes mm; of circles whose files do not state it.
void add_radius(CLI::App& command, StatedCircle& circle);

// An option whose value is one of these words; `at` takes its place among them.
void add_choice(CLI::App& command, const std::string& name, std::vector<std::string> words,
                const std::string& otherwise, const std::string& help, const std::function<void(std::size_t)>& at);

// Throws CLI::ValidationError if one of these options is given, because they need `needed`.
void expect_none_given(const std::vector<CLI::Option*>& options, std::string_view needed);

// "--sequential: cannot be combined with --equal-radii": of options that were both given, though one excludes the
// other.
std::string exclusion_text(const CLI::App& command);

// For all options: an empty value is an error.
void expect_values(CLI::App& app);

// Throws Error if an output is one of the inputs, so that a measurement is never overwritten.
// `option`: that named the outputs.
void expect_no_input(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs,
                     std::string_view option = "--out");

}  // namespace ballbar
