#pragma once

#include <filesystem>
#include <functional>

namespace saca::reach_study {

/// While it lives, others of other programs for the same folder wait. A folder that cannot be
/// opened is not held: nobody can keep anything there either.
class FolderHold {
 public:
  /// Waits until nobody else holds the folder.
  /// @param waits  told once, before it waits
  FolderHold(const std::filesystem::path& folder, const std::function<void()>& waits);
  ~FolderHold();
  FolderHold(const FolderHold&) = delete;
  FolderHold& operator=(const FolderHold&) = delete;

 private:
  int folder_;
};

}  // namespace saca::reach_study
