#include "saca/lab/shell/invocation.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "saca/base/core/printable.h"
#include "saca/lab/shell/quotes.h"

namespace saca::shell {

std::string invocation() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  return invocation_of({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

std::string invocation_of(const std::string& words) {
  std::string text = "saca";
  for (std::size_t begin = words.find('\0'); begin + 1 < words.size();) {
    const std::size_t end = std::min(words.find('\0', begin + 1), words.size());
    text += ' ' + quoted_word(words.substr(begin + 1, end - begin - 1));
    begin = end;
  }
  return one_line(text, 4 * text.size() + 1);  // whole
}

std::string now_in_utc() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", now);
}

bool wants_colours(int file) {
  const char* const unwanted = std::getenv("NO_COLOR");
  return (unwanted == nullptr || *unwanted == 0) && ::isatty(file) != 0;
}

}  // namespace saca::shell
