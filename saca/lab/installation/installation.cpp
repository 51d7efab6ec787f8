#include "saca/lab/installation/installation.h"

#include <cstdlib>

namespace saca::installation {

namespace fs = std::filesystem;

Result<Installation> find_installation(const fs::path& program) {
  std::error_code problem;
  const fs::path folder = program.parent_path();
  for (const fs::path& root : {folder / "../share/saca", folder / "../.."}) {
    if (fs::exists(root / "data" / "harm.toml", problem)) {
      return Installation{.root = fs::weakly_canonical(root, problem),
                          .model_host = folder / "saca-model-host"};
    }
  }
  return Error{Error::Code::unreadable,
               "data/harm.toml is neither beside the program's build folder nor in share/saca"};
}

fs::path usual_cache() {
  if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != 0) {
    return fs::path(cache) / "saca";
  }
  const char* const home = std::getenv("HOME");
  return home == nullptr ? fs::path() : fs::path(home) / ".cache" / "saca";
}

fs::path kept_place(const Installation& here, const fs::path& file) {
  std::error_code problem;
  const bool installed = fs::exists(here.root / file, problem);
  return (installed || here.cache.empty() ? here.root : here.cache) / file;
}

std::string version_text(const Installation& here) {
  return here.version + " (commit " + here.commit + ")";
}

}  // namespace saca::installation
