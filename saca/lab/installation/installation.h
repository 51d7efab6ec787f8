#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/long_work/progress.h"

/// The program's own files, and what is opened from them by name: scenarios, cars, families,
/// models, atlases, tables, and suites with all that they are played with.
namespace saca::installation {

/// Where the program's own files are, and who hears of what is done with them.
struct Installation {
  std::filesystem::path root;        ///< holds data/, models/ and scenarios/
  std::filesystem::path model_host;  ///< program that runs the language model; may be missing
  std::filesystem::path cache;       ///< of what takes long to make; empty: the root
  std::string version;               ///< of the program
  std::string commit;                ///< that it was built from
  std::string model_key;             ///< of servers with language models; empty: none
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
  /// Takes what people should know though all goes on.
  std::function<void(const std::string& message)> notice = [](const std::string&) {};
};

/// Its files are beside it in the build tree, or in share/saca of an installation.
/// @param program  the file that runs
/// @return  `root` and `model_host`; Error::Code::unreadable when neither place has data/harm.toml
[[nodiscard]] Result<Installation> find_installation(const std::filesystem::path& program);

/// $XDG_CACHE_HOME/saca, else ~/.cache/saca; empty where neither variable is set.
[[nodiscard]] std::filesystem::path usual_cache();

/// Where something that takes long to make is looked for, and made: with the program's own files
/// where it was installed with them, else in the cache.
/// @param file  relative
[[nodiscard]] std::filesystem::path kept_place(const Installation& here,
                                               const std::filesystem::path& file);

/// Version and commit: "0.1.0 (commit 13bf0c6a2b1d)".
[[nodiscard]] std::string version_text(const Installation& here);

}  // namespace saca::installation
