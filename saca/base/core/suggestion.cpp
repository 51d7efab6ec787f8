#include "saca/base/core/suggestion.h"

#include <algorithm>

namespace saca {
namespace {

constexpr std::size_t longest_word = 100;  // letters: what is longer is no word

char plain(char letter) {
  return letter == '-'                    ? '_'
         : letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a')
                                          : letter;
}

bool begins_alike(std::string_view text, std::string_view beginning) {
  return text.size() >= beginning.size() &&
         std::equal(beginning.begin(), beginning.end(), text.begin(),
                    [](char a, char b) { return plain(a) == plain(b); });
}

/// A word without its last part: "speed" of "speed_mps"; empty where it has one part only.
std::string_view without_unit(std::string_view word) {
  const auto mark = word.find_last_of("_-");
  return mark == std::string_view::npos ? std::string_view() : word.substr(0, mark);
}

/// What was typed may be a beginning of the word, or the word with another unit.
bool is_part_of(std::string_view typed, std::string_view word) {
  const bool goes_on = word.size() > typed.size() && !typed.empty() && begins_alike(word, typed) &&
                       plain(word[typed.size()]) == '_';
  const std::string_view stem = without_unit(typed);
  return goes_on ||
         (!stem.empty() && stem.size() == without_unit(word).size() && begins_alike(word, stem));
}

}  // namespace

std::size_t typing_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> now(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) {
    last[k] = k;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t other = plain(a[i - 1]) == plain(b[k - 1]) ? 0 : 1;
      now[k] = std::min({last[k] + 1, now[k - 1] + 1, last[k - 1] + other});
      if (i > 1 && k > 1 && plain(a[i - 1]) == plain(b[k - 2]) &&
          plain(a[i - 2]) == plain(b[k - 1])) {
        now[k] = std::min(now[k], before_last[k - 2] + 1);
      }
    }
    before_last.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

std::optional<std::string> likely_meant(std::string_view typed,
                                        std::span<const std::string> known) {
  if (typed.size() > longest_word) {
    return std::nullopt;
  }
  const std::string* nearest = nullptr;
  std::size_t least = 0;
  const std::string* part = nullptr;
  int num_parts = 0;
  for (const std::string& word : known) {
    if (word.size() > longest_word) {
      continue;
    }
    const std::size_t distance = typing_distance(typed, word);
    const std::size_t most = std::max<std::size_t>(1, std::min(typed.size(), word.size()) / 3);
    // A word of one or two letters is another word, not a misspelt one.
    const bool near = distance <= most && distance < std::min(typed.size(), word.size());
    if (near && (nearest == nullptr || distance < least)) {
      nearest = &word;
      least = distance;
    }
    if (is_part_of(typed, word)) {
      part = &word;
      ++num_parts;
    }
  }
  if (nearest != nullptr && least <= 1) {
    return *nearest;
  }
  if (num_parts > 0) {
    return num_parts == 1 ? std::optional(*part) : std::nullopt;
  }
  return nearest == nullptr ? std::nullopt : std::optional(*nearest);
}

std::string suggestion(std::string_view typed, std::span<const std::string> known) {
  if (const auto meant = likely_meant(typed, known)) {
    return "did you mean '" + *meant + "'?";
  }
  std::string list;
  for (const std::string& word : known) {
    list += (list.empty() ? "" : ", ") + word;
  }
  return list.empty() ? "there is none to choose from" : "want one of " + list;
}

}  // namespace saca
