#pragma once

#include <string>
#include <string_view>

#include "saca/base/core/clock.h"

namespace saca::long_work {

/// Whether the line of progress is wanted.
enum class ProgressDisplay { shown, silent };

/// What is worked on, on the error stream. On a terminal, in place: how far it is and how long the
/// rest will take. Anywhere else one line, when this ends: how far it came and how long it took.
class ProgressLine {
 public:
  /// @param all  how many steps there are at most, > 0
  ProgressLine(std::string_view what, int all, Clock& clock, ProgressDisplay display);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @param done        of the steps
  /// @param remembered  of these, how many took no time: they were done before
  /// @param more        what else there is to say of it; may be empty
  void show(int done, int remembered, const std::string& more);

 private:
  std::string what_;
  int all_;
  Clock& clock_;
  Clock::Time start_;
  Clock::Time last_;
  ProgressDisplay display_;
  bool terminal_;
  bool shown_ = false;  ///< has anything been said of how far it is?
  int done_ = 0;
  std::string more_;
};

}  // namespace saca::long_work
