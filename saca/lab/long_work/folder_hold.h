#pragma once

#include <filesystem>
#include <functional>
#include <optional>

namespace saca::long_work {

/// While it lives, nobody else holds the same folder, in this program or another. A folder that
/// cannot be opened is not held: nobody can keep anything there either.
class FolderHold {
 public:
  /// Waits until nobody else holds the folder.
  /// @param waits  told once, before it waits
  FolderHold(const std::filesystem::path& folder, const std::function<void()>& waits);
  /// Waits for nobody.
  /// @return  nullopt: somebody else holds the folder
  [[nodiscard]] static std::optional<FolderHold> unless_held(const std::filesystem::path& folder);
  FolderHold(FolderHold&& other) noexcept;
  FolderHold& operator=(FolderHold&&) = delete;
  ~FolderHold();
  FolderHold(const FolderHold&) = delete;
  FolderHold& operator=(const FolderHold&) = delete;

 private:
  /// Opens the folder, and does not hold it yet.
  explicit FolderHold(const std::filesystem::path& folder);
  /// @return  false: somebody else holds it
  [[nodiscard]] bool holds_at_once() const;

  int folder_;  ///< < 0: it cannot be opened
};

}  // namespace saca::long_work
