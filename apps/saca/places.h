#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::app {

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

/// Where the program's own files are: beside it in the build tree, or in share/saca of an
/// installation.
struct Places {
  std::filesystem::path root;        ///< holds data/ and scenarios/
  std::filesystem::path model_host;  ///< program that runs the language model; may be missing
};

/// @return  Error::Code::unreadable when neither place has data/harm.toml
[[nodiscard]] Result<Places> find_places();

/// A scenario by its path, or by the name of a shipped one.
/// @return  Error::Code::unreadable where there is neither, with the name that was likely meant
[[nodiscard]] Result<std::filesystem::path> find_scenario(const Places& places,
                                                          const std::string& name);

/// A case of `data/reach` likewise.
[[nodiscard]] Result<std::filesystem::path> find_reach_case(const Places& places,
                                                            const std::string& name);

/// A car's file likewise.
[[nodiscard]] Result<std::filesystem::path> find_car(const Places& places, const std::string& name);

/// A family likewise: a shipped one, or a file of the user's own (*.toml).
[[nodiscard]] Result<std::filesystem::path> find_family(const Places& places,
                                                        const std::string& name);

/// The shipped ones' files, by name.
[[nodiscard]] std::vector<std::filesystem::path> shipped_scenarios(const Places& places);

/// Where the atlas of a car is looked for, and built: in the cache (`--cache`, else
/// $XDG_CACHE_HOME/saca, else ~/.cache/saca), unless one was installed with the program's own
/// files.
/// @param car  its name
[[nodiscard]] std::filesystem::path atlas_place(const Places& places, const std::string& car);

/// Likewise one of its tables of danger.
[[nodiscard]] std::filesystem::path danger_place(const Places& places, const std::string& car,
                                                 const std::string& table);

/// Whether the name of an --output ends in .png or .html; where it does not, that is said.
[[nodiscard]] bool is_png_or_html(const std::string& output);

/// Says what is wrong on the error stream.
void complain(const std::string& message);

/// Likewise of each.
void complain_of(const std::vector<std::string>& messages);

/// Says it; the exit code that goes with it.
[[nodiscard]] int refused(const Error& problem);

/// Likewise of a question to a model: what came too late is no wrong input, but `too_slow`.
[[nodiscard]] int unanswered(const Error& problem);

}  // namespace saca::app
