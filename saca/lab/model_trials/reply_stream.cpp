#include "saca/lab/model_trials/reply_stream.h"

#include <fmt/core.h>

#include <utility>

namespace saca::model_trials {

ReplyStream::ReplyStream(std::size_t num_replies,
                         std::function<void(const std::string& text)> write)
    : lines_(num_replies), write_(std::move(write)) {}

void ReplyStream::take(std::size_t number, std::string_view text) {
  if (lines_.size() == 1) {
    write_(std::string(text));
    return;
  }
  std::string& line = lines_.at(number);
  line += text;
  for (std::size_t end = line.find('\n'); end != std::string::npos; end = line.find('\n')) {
    tell(number, line.substr(0, end));
    line.erase(0, end + 1);
  }
}

void ReplyStream::end() {
  for (std::size_t number = 0; number < lines_.size(); ++number) {
    if (lines_.size() > 1 && !lines_[number].empty()) {
      tell(number, lines_[number]);
    }
  }
  write_("\n");
}

void ReplyStream::tell(std::size_t number, std::string_view line) const {
  write_(fmt::format("{} | {}\n", number + 1, line));
}

}  // namespace saca::model_trials
