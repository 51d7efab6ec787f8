#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace saca::model_host {

/// Tokens can end inside a character: gives text on only in whole ones.
class Utf8Splitter {
 public:
  /// @return  what is whole so far; the rest waits for the next call. Bytes that are no UTF-8 pass.
  std::string take(std::string_view bytes) {
    waiting_ += bytes;
    const std::size_t whole = waiting_.size() - unfinished(waiting_);
    std::string result = waiting_.substr(0, whole);
    waiting_.erase(0, whole);
    return result;
  }

 private:
  // Bytes at the end that begin a character without finishing it: 0 to 3.
  static std::size_t unfinished(std::string_view text) {
    for (std::size_t back = 1; back <= 3 && back <= text.size(); ++back) {
      const auto byte = static_cast<unsigned char>(text[text.size() - back]);
      if ((byte & 0xC0U) == 0x80U) {
        continue;  // goes on a character begun before
      }
      const std::size_t length = byte >= 0xF0U ? 4 : byte >= 0xE0U ? 3 : byte >= 0xC0U ? 2 : 1;
      return length > back ? back : 0;
    }
    return 0;
  }

  std::string waiting_;
};

}  // namespace saca::model_host
