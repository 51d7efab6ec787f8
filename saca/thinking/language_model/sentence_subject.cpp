#include "saca/thinking/language_model/sentence_subject.h"

#include <algorithm>
#include <array>

#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/quoted_number.h"
#include "saca/thinking/language_model/words.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;
using preview::Situation;

/// "car3": the kinds' names with a number.
void find_actors(std::string_view low, const Situation& situation, Subject& subject) {
  constexpr std::array<world::ActorKind, 7> kinds{
      world::ActorKind::car,        world::ActorKind::van,     world::ActorKind::truck,
      world::ActorKind::motorcycle, world::ActorKind::bicycle, world::ActorKind::pedestrian,
      world::ActorKind::obstacle};
  for (std::size_t i = 0; i < low.size(); ++i) {
    if (i > 0 && is_word_char(low[i - 1])) {
      continue;
    }
    for (const world::ActorKind kind : kinds) {
      const std::string_view word = name(kind);
      std::size_t end = i + word.size();
      if (low.substr(i, word.size()) != word || end >= low.size() || low[end] < '0' ||
          low[end] > '9') {
        continue;
      }
      while (end < low.size() && is_word_char(low[end])) {
        ++end;
      }
      const std::string_view called = low.substr(i, end - i);
      const auto& actors = situation.scene_at_trigger.actors;
      std::size_t found = 0;
      while (found < actors.size() && actor_name(actors[found]) != called) {
        ++found;
      }
      if (found < actors.size()) {
        subject.actors.push_back(found);
      } else {
        subject.unknown.emplace_back(called);
      }
    }
  }
}

/// Whether a number stands right before a place in the text that is not this one: "8 T-D-R".
bool has_other_number(std::string_view low, std::size_t place, std::size_t number) {
  std::size_t end = place;
  if (end == 0 || low[end - 1] != ' ') {
    return false;
  }
  std::size_t begin = --end;
  while (begin > 0 && low[begin - 1] >= '0' && low[begin - 1] <= '9') {
    --begin;
  }
  const bool alone = begin == 0 || (!is_word_char(low[begin - 1]) && low[begin - 1] != '.');
  return begin < end && alone && low.substr(begin, end - begin) != std::to_string(number);
}

/// "policy 6", "actions 1, 3 and 5", "policies 1 to 4", "6 T-D-R" and "T-D-R".
void find_policies(std::string_view low, Subject& subject) {
  const auto add = [&](PolicyId policy) {
    if (std::find(subject.policies.begin(), subject.policies.end(), policy) ==
        subject.policies.end()) {
      subject.policies.push_back(policy);
    }
  };
  for (const PolicyId policy : manoeuvre::all_policies) {
    const std::string called = lowered(name(policy));
    for (auto at = find_phrase(low, called); at; at = find_phrase(low, called, *at + 1)) {
      add(policy);
      if (has_other_number(low, *at, manoeuvre::index(policy))) {
        subject.misnumbered = policy;
      }
    }
  }
  for (const std::string_view word : {"policy ", "policies ", "action ", "actions "}) {
    for (auto at = low.find(word); at != std::string_view::npos; at = low.find(word, at + 1)) {
      // A list ends with the first thing that is neither a digit by itself nor joins two.
      int last = 0;
      bool begins_range = false;
      for (std::size_t i = at + word.size(); i < low.size();) {
        const bool alone =
            low[i] >= '0' && low[i] <= '7' && (i + 1 == low.size() || !is_word_char(low[i + 1]));
        if (!alone) {
          break;
        }
        const int number = low[i] - '0';
        for (int each = begins_range ? last : number; each <= number; ++each) {
          add(*manoeuvre::policy_from(each));
        }
        last = number;
        ++i;
        const std::string_view joint = joint_at(low.substr(i));
        begins_range = joint == "-" || joint == " to ";
        i += joint.size();
      }
    }
  }
}

/// Whether a line of the prompt is about a policy or a road user that a sentence names.
bool is_line_about(std::string_view line, const Subject& subject, const Situation& situation) {
  const auto is_of = [line](PolicyId policy) { return is_line_of(line, policy); };
  if (std::any_of(subject.policies.begin(), subject.policies.end(), is_of)) {
    return true;
  }
  const std::string low = lowered(line);
  if (is_line_of_case(line)) {
    return subject.of_case &&
           std::any_of(subject.policies.begin(), subject.policies.end(),
                       [&](PolicyId policy) { return has_phrase(low, lowered(name(policy))); });
  }
  const bool of_another_policy =
      !subject.policies.empty() &&
      std::any_of(manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(), is_of);
  return !of_another_policy &&
         std::any_of(subject.actors.begin(), subject.actors.end(), [&](std::size_t i) {
           return has_phrase(low, actor_name(situation.scene_at_trigger.actors[i]));
         });
}

}  // namespace

Subject subject_of(std::string_view low, const Situation& situation) {
  Subject subject;
  find_actors(low, situation, subject);
  find_policies(low, subject);
  const bool left = has_any(low, std::array<std::string_view, 2>{"left", "leftward"});
  const bool right = has_any(low, std::array<std::string_view, 2>{"right", "rightward"});
  subject.side = left == right ? 0 : left ? 1 : -1;
  subject.of_case =
      has_any(low, std::array<std::string_view, 4>{"case", "cases", "alike", "hindsight"});
  return subject;
}

std::string lines_about(std::string_view prompt, const Subject& subject,
                        const Situation& situation) {
  if (subject.actors.empty() && subject.policies.empty()) {
    return std::string(prompt);
  }
  std::string found;
  for (std::size_t begin = 0; begin < prompt.size();) {
    const std::size_t end = std::min(prompt.find('\n', begin), prompt.size());
    const std::string_view line = prompt.substr(begin, end - begin);
    // What the ego is and does may be said beside anybody.
    if (is_line_about(line, subject, situation) || is_line_of_ego(line)) {
      found += line;
      found += '\n';
    }
    begin = end + 1;
  }
  return found;
}

}  // namespace saca::language_model
