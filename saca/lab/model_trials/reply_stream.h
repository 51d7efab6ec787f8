#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace saca::model_trials {

/// Tells what several replies say while they grow: one as it comes, more of them line by line, each
/// line with the number of its reply.
class ReplyStream {
 public:
  /// @param write  takes what is to be seen next
  ReplyStream(std::size_t num_replies, std::function<void(const std::string& text)> write);

  /// @param number  of the reply, from 0 on
  void take(std::size_t number, std::string_view text);
  /// Tells lines that did not end, and ends the last.
  void end();

 private:
  void tell(std::size_t number, std::string_view line) const;

  std::vector<std::string> lines_;
  std::function<void(const std::string& text)> write_;
};

}  // namespace saca::model_trials
