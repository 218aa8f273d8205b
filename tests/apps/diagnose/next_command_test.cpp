#include "diagnose/next_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

BoundEffect bound(std::string_view name, std::vector<std::string> columns) {
  return {find_effect(name, Level::series), std::move(columns)};
}

ModelOptions options() {
  ModelOptions options;
  options.data = {"run 1.csv"};
  options.model = "model.toml";
  return options;
}

Candidate candidate(BoundEffect bound, double p) {
  Candidate one;
  one.bound = std::move(bound);
  one.p = p;
  return one;
}

Diagnosis found(Verdict verdict) {
  Diagnosis diagnosis;
  diagnosis.target = "y_um";
  diagnosis.verdict = verdict;
  return diagnosis;
}

TEST(NextCommand, all_that_is_named_is_added_at_once) {
  Diagnosis named = found(Verdict::named);
  named.named = {bound("expansion", {"T_room_degC"}), bound("gradient_bending", {"T a_degC", "T'b_degC"})};
  named.probable = {bound("linear_drift", {})};
  EXPECT_EQ(next_command(options(), named),
            "ballbar add 'expansion(T_room_degC)' 'gradient_bending(T a_degC, T'\\''b_degC)' "
            "'run 1.csv' --model model.toml --target y_um");
}

TEST(NextCommand, what_is_probable_is_added_and_what_is_in_question_tried) {
  Diagnosis diagnosis = found(Verdict::probable);
  diagnosis.probable = {bound("linear_drift", {})};
  EXPECT_EQ(next_command(options(), diagnosis),
            "ballbar add linear_drift 'run 1.csv' --model model.toml --target y_um");
  for (const Verdict verdict : {Verdict::equivalent, Verdict::driver, Verdict::unexplained}) {
    diagnosis = found(verdict);
    EXPECT_EQ(next_command(options(), diagnosis), "");
    diagnosis.candidates = {candidate(bound("linear_drift", {}), 0.7)};
    EXPECT_EQ(next_command(options(), diagnosis), "");  // not of the most probable set
    diagnosis.candidates.front().in_best_set = true;
    EXPECT_EQ(next_command(options(), diagnosis),
              "ballbar add linear_drift 'run 1.csv' --model model.toml --target y_um --dry-run");
    diagnosis.equivalent = {{bound("expansion", {"T_room_degC"}), bound("linear_drift", {})}};
    diagnosis.candidates.push_back(candidate(bound("expansion", {"T_room_degC"}), 0.58));
    EXPECT_EQ(next_command(options(), diagnosis),  // not of a sure driver
              "ballbar add linear_drift 'run 1.csv' --model model.toml --target y_um --dry-run");
    diagnosis.drivers = {{"T_room_degC", 0.95}};
    EXPECT_EQ(next_command(options(), diagnosis),
              "ballbar add 'expansion(T_room_degC)' 'run 1.csv' --model model.toml --target y_um --dry-run");
    for (Candidate& one : diagnosis.candidates) one.p = 0.49;
    EXPECT_EQ(next_command(options(), diagnosis), "");  // the test that decides is the next step
  }
}

// A fit starts where the diagnosis found the effect: a moment to a second in months, a period, a time constant.
TEST(NextCommand, says_the_shapes_that_were_found) {
  const auto shaped = [](BoundEffect bound, std::size_t k, double value) {
    Candidate one = candidate(std::move(bound), 0.99);
    for (const Parameter& parameter : one.bound.effect->parameters) {
      one.parameters.push_back({one.label, parameter.name, parameter.unit, 1.0, 0.1, {}, parameter.kind});
      one.parameters.back().shape_of = parameter.shape_of;
      one.parameters.back().state = ParameterState::held;
    }
    one.parameters[k].value = value;
    one.parameters[k].state = ParameterState::free;
    return one;
  };
  Diagnosis diagnosis = found(Verdict::named);
  diagnosis.named = {bound("step", {}), bound("thermostat_cycle", {}), bound("lagged_expansion", {"T_room_degC"}),
                     bound("expansion", {"T_room_degC"})};
  diagnosis.candidates = {shaped(diagnosis.named[0], 1, 50820.0), shaped(diagnosis.named[1], 2, 242.1337),
                          shaped(diagnosis.named[2], 1, 17682.4), shaped(diagnosis.named[3], 0, 2.0)};
  EXPECT_EQ(next_command(options(), diagnosis),
            "ballbar add 'step(onset_s = 50820)' 'thermostat_cycle(period_s = 242.134)' "
            "'lagged_expansion(T_room_degC, time_constant_s = 17680)' 'expansion(T_room_degC)' 'run 1.csv' --model "
            "model.toml --target y_um");
}

TEST(NextCommand, no_jump_beside_one_of_the_model) {
  Diagnosis diagnosis = found(Verdict::named);
  for (int i = 0; i < 100; ++i) diagnosis.base.time_s.push_back(60.0 * i);
  FittedParameter held{"step(onset_s = 3000)", "onset_s", "s", 3010.0};
  held.shape_of = ShapeOf::onset;
  diagnosis.base.parameters = {held};
  diagnosis.named = {bound("step", {})};
  diagnosis.candidates = {candidate(bound("step", {}), 0.99)};
  diagnosis.candidates.front().parameters = {held};
  for (const double near_s : {2880.0, 3000.0, 3180.0}) {
    diagnosis.candidates.front().parameters[0].value = near_s;
    EXPECT_EQ(next_command(options(), diagnosis), "") << near_s;
  }
  diagnosis.candidates.front().parameters[0].value = 3300.0;
  EXPECT_EQ(next_command(options(), diagnosis),
            "ballbar add 'step(onset_s = 3300)' 'run 1.csv' --model model.toml --target y_um");
}

TEST(NextCommand, what_the_user_typed_comes_again) {
  Diagnosis diagnosis = found(Verdict::named);
  diagnosis.named = {bound("linear_drift", {})};
  ModelOptions typed = options();
  typed.data = {"-a.csv"};
  typed.also_input = {"z_um"};
  typed.max_gap_s = 90.0;
  typed.left_out = {{3600.0, 7200.5}};
  EXPECT_EQ(next_command(typed, diagnosis),
            "ballbar add linear_drift ./-a.csv --model model.toml --target y_um --also-input z_um --max-gap 90s "
            "--leave-out-times 3600s..7200.5s");
}

TEST(NextCommand, there_is_none_where_nothing_is_to_be_added) {
  Diagnosis diagnosis = found(Verdict::nothing);
  diagnosis.candidates.push_back({});
  diagnosis.candidates.front().bound = bound("linear_drift", {});
  EXPECT_EQ(next_command(options(), diagnosis), "");
  EXPECT_EQ(next_hint(options(), diagnosis), "");
  diagnosis.verdict = Verdict::untestable;
  EXPECT_EQ(next_command(options(), diagnosis), "");
  diagnosis.verdict = Verdict::named;
  diagnosis.named = {bound("expansion", {"T,room_degC"})};  // would be two columns
  EXPECT_EQ(next_command(options(), diagnosis), "");
  diagnosis.named = {bound("expansion", {"T\x1b[2J_degC"})};
  EXPECT_EQ(next_command(options(), diagnosis), "");
}

TEST(NextCommand, a_held_value_is_freed_by_hand) {
  Diagnosis diagnosis = found(Verdict::named);
  diagnosis.own.push_back({"speed_heating(speed_rpm)", "exponent", "1", 5.0 / 3.0, 1.02, {0.9, 1.1}, 0.95});
  diagnosis.own.push_back({"speed_heating(speed_rpm)", "time_constant_s", "s", 100.0, 300.0, {200.0, 400.0}, 0.4});
  EXPECT_EQ(next_command(options(), diagnosis), "");
  EXPECT_EQ(next_hint(options(), diagnosis),
            "In model.toml, free the exponent of speed_heating(speed_rpm): exponent = { start = 1.02 }.");
}

// `add` makes it, under a name that no file has; `--dry-run` needs none.
TEST(NextCommand, without_a_model_file) {
  Diagnosis diagnosis = found(Verdict::named);
  diagnosis.named = {bound("expansion", {"T_room_degC"})};
  ModelOptions none = options();
  none.model = {};
  EXPECT_EQ(model_file(options()), "model.toml");
  const std::string name = model_file(none);
  EXPECT_FALSE(std::filesystem::exists(name));
  EXPECT_EQ(next_command(none, diagnosis),
            "ballbar add 'expansion(T_room_degC)' 'run 1.csv' --model " + name + " --target y_um");
  EXPECT_EQ(next_hint(none, diagnosis), "");
  diagnosis.verdict = Verdict::equivalent;
  diagnosis.equivalent = {{bound("linear_drift", {})}};
  diagnosis.candidates = {candidate(bound("linear_drift", {}), 0.6)};
  EXPECT_EQ(next_command(none, diagnosis), "ballbar add linear_drift 'run 1.csv' --target y_um --dry-run");
}

// What a page's button does: the same effects without a shell, an effect that is in doubt tried, a value freed.
TEST(NextAction, is_the_next_command_as_data) {
  Diagnosis diagnosis = found(Verdict::named);
  diagnosis.named = {bound("expansion", {"T room_degC"})};
  const auto add = next_action(options(), diagnosis);
  ASSERT_TRUE(add);
  EXPECT_EQ(add->action, Action::add);
  EXPECT_EQ(add->effects, std::vector<std::string>{"expansion(T room_degC)"});
  EXPECT_EQ(add->labels, add->effects);
  EXPECT_FALSE(add->promised_rmse_um);
  diagnosis.verdict = Verdict::equivalent;
  diagnosis.equivalent = {{bound("linear_drift", {})}};
  diagnosis.candidates = {candidate(bound("linear_drift", {}), 0.6)};
  EXPECT_EQ(next_action(options(), diagnosis)->action, Action::try_out);
  diagnosis.candidates.clear();
  EXPECT_EQ(next_action(options(), diagnosis)->action, Action::plan);
  EXPECT_FALSE(next_action(options(), found(Verdict::nothing)));
  Diagnosis held = found(Verdict::named);
  held.own.push_back({"speed_heating(speed_rpm)", "exponent", "1", 5.0 / 3.0, 1.02, {0.9, 1.1}, 0.95});
  const auto free = next_action(options(), held);
  ASSERT_TRUE(free);
  EXPECT_EQ(free->action, Action::free);
  ASSERT_EQ(free->parameters.size(), 1U);
  EXPECT_EQ(free->parameters[0].parameter, "exponent");
  EXPECT_EQ(free->parameters[0].start, 1.02);
}

TEST(NextCommand, words_are_quoted_where_a_shell_would_part_them) {
  EXPECT_EQ(shell_word("a_b-c./=:,+@%9"), "a_b-c./=:,+@%9");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("$(x)'"), "'$(x)'\\'''");
}

}  // namespace
}  // namespace ballbar
