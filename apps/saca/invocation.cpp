#include "apps/saca/invocation.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>

#include "saca/base/core/printable.h"

namespace saca::app {
namespace {

/// In single quotes where the shell would see more in it than a word.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string("_-./=:,@+%").find(c) != std::string::npos;
  });
  return plain ? word : in_quotes(word);
}

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char letter : text) {
    out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  }
  return out + "'";
}

std::string invocation() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);  // words that end in 0
  const std::string words((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::string text = "saca";
  for (std::size_t begin = words.find('\0'); begin + 1 < words.size();) {
    const std::size_t end = std::min(words.find('\0', begin + 1), words.size());
    text += ' ' + quoted(words.substr(begin + 1, end - begin - 1));
    begin = end;
  }
  return one_line(text, 4 * text.size() + 1);  // whole
}

std::string now_in_utc() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", now);
}

}  // namespace saca::app
