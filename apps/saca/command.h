#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/printable.h"
#include "saca/base/formats/short_numbers.h"
#include "saca/lab/installation/inputs.h"

/// The command line: what every command is made of. A command reads what its options name, has the
/// laboratory work it out, and tells or writes what came; where something cannot be used it ends at
/// once, with one line on the error stream and the exit code that goes with it.
namespace saca::app {

namespace fs = std::filesystem;

/// Exit codes, as docs/formats.md tells them.
enum ExitCode : int {
  success = 0,
  internal_error = 1,
  wrong_command_line = 2,
  bad_input = 3,
  cannot_write = 4,
  some_failed = 5,        ///< of many encounters, some could not be played or a method failed
  not_the_same = 6,       ///< something came out otherwise than it was recorded
  nothing_to_decide = 7,  ///< nothing threatens in the scenario: there is nothing to tell
  too_slow = 8,           ///< the machine, or the model, did not answer in the time it had
  was_interrupted = 130,  ///< as shells say it: 128 + SIGINT
};

/// Ends the program; what is to be said has been said.
struct Exit {
  ExitCode code = success;
};

// How a command ends before its time.

/// Says what is wrong on the error stream.
void complain(const std::string& message);
void complain_of(const std::vector<std::string>& messages);

/// Says it, and ends the command.
[[noreturn]] void refuse(ExitCode code, const std::string& message);
/// Likewise, with `cannot_write` where it is that, else `bad_input`.
/// @param too_late  of Error::Code::too_late: work was interrupted, or a model was not asked in
/// time
[[noreturn]] void refuse(const Error& problem, ExitCode too_late = bad_input);

/// What was read or worked out; where there is an error, the command ends with it.
template <class T>
[[nodiscard]] T need(Result<T> result, ExitCode too_late = bad_input) {
  if (!result.has_value()) {
    refuse(result.error(), too_late);
  }
  return std::move(result).value();
}
void need(const std::optional<Error>& problem);

/// Likewise where it is the command line that is wrong.
template <class T>
[[nodiscard]] T need_of_line(Result<T> result) {
  if (!result.has_value()) {
    refuse(wrong_command_line, result.error().message);
  }
  return std::move(result).value();
}

inline constexpr const char* goes_on =
    "interrupted; the same command goes on where this one stopped";

/// Likewise of work that can be interrupted.
/// @param message  where it was: what is said
template <class T>
[[nodiscard]] T need_whole(Result<std::optional<T>> result, const std::string& message = goes_on) {
  std::optional<T> whole = need(std::move(result));
  if (!whole) {
    refuse(was_interrupted, message);
  }
  return *std::move(whole);
}

/// Before long work: that these files can be written; an empty name is none.
void need_writable(std::initializer_list<fs::path> files);

/// Whether two names are of one file; it need not be there yet.
[[nodiscard]] bool is_same_file(const fs::path& one, const fs::path& other);

/// A file, and the words of the command line that name it.
struct NamedFile {
  std::string what;  ///< "--output", "the record"
  fs::path file;     ///< empty: none
};
/// Before the work: that no output is one of the inputs or another output, over which it would be
/// written. A device may stand for several.
void need_distinct(const std::vector<NamedFile>& outputs,
                   const std::vector<NamedFile>& inputs = {});

/// Leaves a file, in a folder that is made for it.
void write(const fs::path& file, const std::string& text);

// What a command prints.

/// Prints what a terminal may get, whatever a file, a path, a model or a server had in it: see
/// `printable`. All that the program says goes through here, but a story and a line of progress,
/// which have commands of their own.
/// @throws std::system_error  if it cannot be written
template <class... Args>
void print(std::FILE* file, fmt::format_string<Args...> format, Args&&... args) {
  fmt::print(file, "{}", printable(fmt::format(format, std::forward<Args>(args)...)));
}
template <class... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  app::print(stdout, format, std::forward<Args>(args)...);
}

/// What `--json` prints, but for what the library writes itself: numbers as a person would write
/// them, and U+FFFD for what is no UTF-8.
/// @tparam Json  nlohmann::json, or ordered_json
template <class Json>
[[nodiscard]] std::string json_text(Json document) {
  return formats::with_short_numbers(std::move(document))
             .dump(1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

/// Tells what came: as a document for programs, or in words.
template <class Json>
void tell(bool as_json, Json document, const std::string& text) {
  app::print("{}", as_json ? json_text(std::move(document)) : text);
}

/// Prints in words what is found while work goes on; a document for programs follows at its end.
void tell_meanwhile(bool as_json, const std::string& text);

/// Figures, and who made them.
/// @param command  without the program's name
[[nodiscard]] nlohmann::json with_meta(nlohmann::json figures, const std::string& command);

// What a command works with.

/// What stands before the command and holds for all of them.
struct Settings {
  bool quiet = false;  ///< neither progress nor story: errors, and what was asked for
  std::string cache;   ///< where tables and atlases are kept; empty: in the user's cache
};
/// This process's; they are set once, while the line is read.
[[nodiscard]] Settings& settings();

/// What `--quiet` leaves of lines of progress.
[[nodiscard]] long_work::ProgressDisplay progress_display();

/// This program's own files; where they are not there, the command ends.
[[nodiscard]] const installation::Installation& here();

/// As installation::read_inputs and so on, from there.
[[nodiscard]] installation::Inputs read_inputs(const std::string& car);
[[nodiscard]] installation::ScenarioInputs read_scenario_inputs(const std::string& scenario);

/// The file of a car that --car names, for need_distinct.
[[nodiscard]] NamedFile car_file(const std::string& car);

/// The commit that the program was built from: "13bf0c6a2b1d", with "-dirty" behind it where files
/// had been changed; "unknown" where that was no checkout. Defined in a file that is made in every
/// build (cmake/Commit.cmake).
[[nodiscard]] const char* built_from();

// How a command is added to the line.

/// A command that was added, and what its options are put into.
template <class Options>
struct AddedCommand {
  CLI::App& line;
  Options& options;
};

/// Adds a command that does `run` with its options.
/// @param run  returns nothing, or the exit code
template <class Options, class End>
AddedCommand<Options> add_command(
    CLI::App& parent, const std::string& name, const std::string& about, End (*run)(const Options&),
    const std::shared_ptr<Options>& options = std::make_shared<Options>()) {
  CLI::App* const command = parent.add_subcommand(name, about);
  command->callback([options, run] {
    if constexpr (std::is_void_v<End>) {
      run(*options);
    } else if (const ExitCode code = run(*options); code != success) {
      throw Exit{code};
    }
  });
  return {*command, *options};
}

/// Adds a command that is nothing without one of those below it.
[[nodiscard]] CLI::App& add_group(CLI::App& parent, const std::string& name,
                                  const std::string& about);

// Each adds one command to the line, with all below it.

void add_run(CLI::App& line);
void add_replay(CLI::App& line);
void add_explain(CLI::App& line);
void add_report(CLI::App& line);
void add_verify(CLI::App& line);
void add_scenarios(CLI::App& line);
void add_import(CLI::App& line);
void add_memory(CLI::App& line);
void add_cases(CLI::App& line);
void add_reason(CLI::App& line);
void add_model(CLI::App& line);
void add_physics(CLI::App& line);
void add_drive(CLI::App& line);
void add_harm(CLI::App& line);
void add_oracle(CLI::App& line);
void add_whatif(CLI::App& line);
void add_family(CLI::App& line);
void add_cues(CLI::App& line);
void add_balance(CLI::App& line);
void add_forecast(CLI::App& line);
void add_ladder(CLI::App& line);
void add_learn(CLI::App& line);
void add_tables(CLI::App& line);
void add_suite(CLI::App& line);
void add_search_showcase(CLI::App& line);
void add_tune(CLI::App& line);
void add_atlas(CLI::App& line);
void add_danger(CLI::App& line);
void add_reach(CLI::App& line);
void add_intent(CLI::App& line);
void add_traffic(CLI::App& line);
void add_vehicle(CLI::App& line);
void add_bench(CLI::App& line);
void add_shell_files(CLI::App& line);  ///< completion and manual pages of all that was added before

}  // namespace saca::app
