// The commands of `ballbar`, one file each. Every one adds its options to the command line; its work runs
// from the callback and returns by printing results to stdout, remarks to stderr, or by throwing Error.
#pragma once

namespace CLI {
class App;
}

namespace ballbar::commands {

void add_fit(CLI::App& app);
void add_import(CLI::App& app);
void add_drift(CLI::App& app);
void add_compare(CLI::App& app);
void add_errors(CLI::App& app);
void add_history(CLI::App& app);
void add_simulate(CLI::App& app);
void add_effects(CLI::App& app);
void add_could(CLI::App& app);
void add_check(CLI::App& app);
void add_diagnose(CLI::App& app);
void add_predict(CLI::App& app);
void add_plan(CLI::App& app);
void add_add(CLI::App& app);
void add_undo(CLI::App& app);
void add_ledger(CLI::App& app);
void add_train(CLI::App& app);
void add_report(CLI::App& app);
void add_compensate(CLI::App& app);

}  // namespace ballbar::commands
