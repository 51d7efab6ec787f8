#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca {

/// What a long piece of work has found so far, a line each, so that it can be interrupted, even
/// killed, and goes on where it was. One writer at a time.
class Journal {
 public:
  /// Opens the journal of the work called `title`, or begins it.
  /// @param title  one line that names everything on which the lines depend
  /// @return       Error::Code::malformed when the file is the journal of other work;
  ///               unreadable, unwritable
  [[nodiscard]] static Result<Journal> open(const std::filesystem::path& path,
                                            const std::string& title);

  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&&) = delete;
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  /// What stood there when it was opened, without the title. A line that a kill cut short is
  /// dropped.
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

  /// Adds one line at once.
  /// @return  false when the disk did not take it
  [[nodiscard]] bool add(std::string_view line) const;

 private:
  Journal() = default;
  std::vector<std::string> lines_;
  int file_ = -1;
};

}  // namespace saca
