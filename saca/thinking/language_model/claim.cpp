#include "saca/thinking/language_model/claim.h"

#include <algorithm>
#include <array>

#include "saca/base/world/cue.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/words.h"

namespace saca::language_model {

std::string without_cues(std::string_view low) {
  std::string rest(low);
  for (std::size_t kind = 0; kind < world::num_cue_kinds; ++kind) {
    const std::string_view cue = cue_text(static_cast<world::CueKind>(kind));
    for (auto at = rest.find(cue); at != std::string::npos; at = rest.find(cue)) {
      rest.erase(at, cue.size());
    }
  }
  return rest;
}

bool is_denied(std::string_view text) {
  const std::string low = without_cues(text);
  using Phrases = std::array<std::string_view, 9>;
  if (low.find("n't") != std::string_view::npos ||
      has_any(low, Phrases{"nothing", "nobody", "no one", "no longer", "never", "except", "unlike",
                           "but", "other than"})) {
    return true;
  }
  for (auto at = find_phrase(low, "not"); at; at = find_phrase(low, "not", *at + 1)) {
    const std::string_view rest = std::string_view(low).substr(*at + 3);
    constexpr std::array<std::string_view, 6> known{" possible", " viable",  " clear",
                                                    " hit",      " collide", " strike"};
    if (std::none_of(known.begin(), known.end(),
                     [&](std::string_view word) { return rest.starts_with(word); })) {
      return true;
    }
  }
  return false;
}

std::optional<Claim> claim_of(std::string_view low) {
  using Phrases = std::array<std::string_view, 4>;
  if (is_denied(low)) {
    return std::nullopt;
  }
  if (has_any(low, Phrases{"not possible", "impossible", "cannot be driven", "infeasible"})) {
    return Claim::not_possible;
  }
  if (has_any(low, Phrases{"blocked", "not viable", "blocks", "blocking"})) {
    return Claim::blocked;
  }
  if (has_any(low, Phrases{"least harm", "lowest harm", "smallest harm", "minimal harm"})) {
    return Claim::least_harm;
  }
  if (has_any(low, Phrases{"not clear", "no clear", "unclear", "clearly"})) {
    return std::nullopt;
  }
  if (has_any(low, std::array<std::string_view, 2>{"leaves the road", "leave the road"})) {
    return has_phrase(low, "cannot leave") ? std::nullopt : std::optional(Claim::leaves);
  }
  const bool avoids =
      has_any(low, Phrases{"no contact", "no collision", "avoids", "without contact"});
  if (!avoids && has_any(low, Phrases{"hits", "hit", "collides", "strikes"})) {
    return has_any(low, Phrases{"not hit", "does not", "not collide", "not strike"})
               ? std::optional(Claim::clear)
               : std::optional(Claim::hits);
  }
  if (avoids || has_any(low, Phrases{"clear", "is clear", "clears", "free"})) {
    return Claim::clear;
  }
  if (has_any(low, Phrases{"no harm", "without harm", "harmless", "zero harm"})) {
    return Claim::no_harm;
  }
  return std::nullopt;
}

std::vector<std::string_view> clauses(std::string_view sentence) {
  std::vector<std::string_view> all;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    const std::string_view rest = sentence.substr(i);
    for (const std::string_view joint : {", but ", ", ", " but ", " while ", " and "}) {
      if (rest.starts_with(joint) && claim_of(lowered(sentence.substr(begin, i - begin)))) {
        all.push_back(sentence.substr(begin, i - begin));
        begin = i + joint.size();
        break;
      }
    }
  }
  all.push_back(sentence.substr(begin));
  return all;
}

}  // namespace saca::language_model
