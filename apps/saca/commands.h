#pragma once

#include <CLI/CLI.hpp>

namespace saca::app {

// Each adds one command to the line; what it is to return as exit code comes out of `exit_code`
// when that command was the one.

void add_run(CLI::App& line, int& exit_code);
void add_replay(CLI::App& line, int& exit_code);
void add_explain(CLI::App& line, int& exit_code);
void add_report(CLI::App& line, int& exit_code);
void add_verify(CLI::App& line, int& exit_code);
void add_scenarios(CLI::App& line, int& exit_code);
void add_import(CLI::App& line, int& exit_code);
void add_memory(CLI::App& line, int& exit_code);
void add_cases(CLI::App& line, int& exit_code);
void add_reason(CLI::App& line, int& exit_code);
void add_model(CLI::App& line, int& exit_code);
void add_physics(CLI::App& line, int& exit_code);
void add_drive(CLI::App& line, int& exit_code);
void add_harm(CLI::App& line, int& exit_code);
void add_oracle(CLI::App& line, int& exit_code);
void add_whatif(CLI::App& line, int& exit_code);
void add_family(CLI::App& line, int& exit_code);
void add_cues(CLI::App& line, int& exit_code);
void add_balance(CLI::App& line, int& exit_code);
void add_forecast(CLI::App& line, int& exit_code);
void add_ladder(CLI::App& line, int& exit_code);
void add_learn(CLI::App& line, int& exit_code);
void add_tables(CLI::App& line, int& exit_code);
void add_suite(CLI::App& line, int& exit_code);
void add_search_showcase(CLI::App& line, int& exit_code);
void add_tune(CLI::App& line, int& exit_code);
void add_atlas(CLI::App& line, int& exit_code);
void add_danger(CLI::App& line, int& exit_code);
void add_reach(CLI::App& line, int& exit_code);
void add_intent(CLI::App& line, int& exit_code);
void add_traffic(CLI::App& line, int& exit_code);
void add_vehicle(CLI::App& line, int& exit_code);
void add_bench(CLI::App& line, int& exit_code);
void add_completion(CLI::App& line, int& exit_code);  ///< after all that it is to complete
void add_man(CLI::App& line, int& exit_code);         ///< likewise

}  // namespace saca::app
