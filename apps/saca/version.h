#pragma once

#include <string>

namespace saca::app {

/// The commit that the program was built from: "13bf0c6a2b1d", with "-dirty" behind it where files
/// had been changed; "unknown" where that was no checkout. Defined in a file that is made in every
/// build (cmake/Commit.cmake).
[[nodiscard]] const char* built_from();

/// Version and commit: "0.1.0 (commit 13bf0c6a2b1d)".
[[nodiscard]] std::string version_text();

}  // namespace saca::app
