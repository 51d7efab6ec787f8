#include "saca/thinking/language_model/quote.h"

#include <algorithm>
#include <utility>

#include "saca/base/core/printable.h"

namespace saca::language_model {
namespace {

constexpr std::size_t longest_quote = 200;  // characters
// Bytes that are looked at: 200 characters of four, and what stars make shorter.
constexpr std::size_t quoted_bytes = 4096;
constexpr std::size_t shortest_secret = 8;  // a shorter run may be chance

// How many characters of `text` stand in this order somewhere in `secret`.
std::size_t common_run(std::string_view text, std::string_view secret) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const std::string_view rest = secret.substr(i);
    const auto [in_text, in_secret] =
        std::mismatch(text.begin(), text.end(), rest.begin(), rest.end());
    longest = std::max(longest, static_cast<std::size_t>(in_text - text.begin()));
  }
  return longest;
}

std::string masked(std::string_view text, std::string_view secret) {
  const std::size_t shortest = std::min(shortest_secret, secret.size());
  std::string result;
  while (!text.empty()) {
    const std::size_t run = common_run(text, secret);
    const bool hide = run > 0 && run >= shortest;
    result += hide ? std::string_view("***") : text.substr(0, 1);
    text.remove_prefix(hide ? run : 1);
  }
  return result;
}

}  // namespace

std::string quote(std::string_view text, std::string_view secret) {
  return one_line(masked(text.substr(0, quoted_bytes), secret), longest_quote);
}

std::string SecretFilter::take(std::string_view piece) {
  waiting_ += piece;
  // The longest end that stands in the secret may go on to be more of it.
  std::size_t kept = std::min(waiting_.size(), secret_.size());
  while (kept > 0 && secret_.find(waiting_.substr(waiting_.size() - kept)) == std::string::npos) {
    --kept;
  }
  const std::string_view known = std::string_view(waiting_).substr(0, waiting_.size() - kept);
  std::string shown = masked(known, secret_);
  waiting_.erase(0, known.size());
  return shown;
}

std::string SecretFilter::rest() {
  return masked(std::exchange(waiting_, {}), secret_);
}

}  // namespace saca::language_model
