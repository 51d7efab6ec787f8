#include "saca/thinking/language_model/reply_grammar.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "saca/thinking/language_model/gbnf.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/statements.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;

using gbnf::literal;
using gbnf::literals;
using gbnf::one_of;
using gbnf::perhaps;

/// The kinds of statements, in the order in which they are made; each may be left out but the
/// conclusion.
constexpr std::array<std::string_view, 4> statement_kinds{"threat", "end", "warning", "remark"};

class Grammar {
 public:
  Grammar(const Statements& statements, std::vector<PolicyId> choices, std::size_t num_actors,
          const memory::Policies& may)
      : statements_(statements), choices_(std::move(choices)), may_(may) {
    add_threats(num_actors);
    add_ends();
    add("warning", literals(statements_.warnings()));
    add_remarks();
    add_conclusions();
  }

  [[nodiscard]] std::string text() const {
    std::string rules = "root ::= \"Scenario Analysis\\n\" from-1-0\n";
    for (int number = 1; number <= most_statements; ++number) {
      const auto least = static_cast<std::size_t>(number) - 1;
      for (std::size_t next = least; next <= (number == 1 ? 0 : statement_kinds.size()); ++next) {
        rules += rest(number, next);
      }
    }
    return rules + rules_;
  }

 private:
  /// A rule for one of these; none where there is none.
  void add(std::string_view name, const std::vector<std::string>& parts) {
    if (!parts.empty()) {
      rules_ += fmt::format("{} ::= {}\n", name, fmt::join(parts, " | "));
      known_.emplace_back(name);
    }
  }

  /// What can follow when so many statements have been made, and the next is of this kind or a
  /// later one.
  [[nodiscard]] std::string rest(int number, std::size_t next) const {
    std::vector<std::string> ways{std::string(gbnf::conclusion_rule)};
    for (std::size_t kind = next; number < most_statements && kind < statement_kinds.size();
         ++kind) {
      if (std::find(known_.begin(), known_.end(), statement_kinds.at(kind)) != known_.end()) {
        ways.push_back(fmt::format("{} {} from-{}-{}", statement_kinds.at(kind), R"(".\n")",
                                   number + 1, kind + 1));
      }
    }
    return fmt::format("from-{}-{} ::= {} {}\n", number, next, literal(fmt::format("{}. ", number)),
                       one_of(ways));
  }

  void add_threats(std::size_t num_actors) {
    const std::optional<std::size_t> most = statements_.most_dangerous();
    std::vector<std::string> all;
    for (std::size_t i = 0; i < num_actors; ++i) {
      if (!statements_.is_told(i)) {
        continue;
      }
      const RoadUserPieces pieces = statements_.pieces_of(i);
      std::vector<std::string> ends;
      for (const PolicyId policy : manoeuvre::all_policies) {
        if (const std::string end = statements_.end_beside(policy, i); !end.empty()) {
          ends.push_back(literal(": " + end) + with_harm(policy));
        }
      }
      all.push_back(fmt::format("{} {} {} {} {} {}",
                                i == most ? perhaps(literals(statements_.addresses())) : "",
                                literal(pieces.who), perhaps(literals({pieces.beside})),
                                perhaps(literals({pieces.intention, pieces.conflict, pieces.risk})),
                                perhaps(literals({pieces.unprotected})), perhaps(ends)));
    }
    add("threat", all);
  }

  [[nodiscard]] std::string with_harm(PolicyId policy) const {
    return ' ' + perhaps(literals({statements_.with_harm(policy)}));
  }

  void add_ends() {
    std::vector<std::string> all;
    for (const PolicyId policy : manoeuvre::all_policies) {
      all.push_back(literal(statements_.end_of(policy)) + with_harm(policy));
    }
    add("end", all);
  }

  void add_remarks() {
    std::vector<std::string> all;
    for (const Remark& remark : statements_.remarks()) {
      const bool is_against = std::any_of(choices_.begin(), choices_.end(), [&](PolicyId choice) {
        return manoeuvre::side(choice) == remark.side;
      });
      if (!remark.rules_out || !is_against) {
        const std::vector<std::string> wordings = literals(remark.wordings);
        all.insert(all.end(), wordings.begin(), wordings.end());
      }
    }
    add("remark", all);
  }

  void add_conclusions() {
    std::vector<std::string> all;
    for (const PolicyId choice : choices_) {
      for (const PolicyId other : others(choice)) {
        all.push_back(literal(statements_.conclusion(choice, other)) + ' ' +
                      perhaps(literals(statements_.advantages(choice, other))));
      }
      if (!statements_.next_best(choice)) {
        all.push_back(literal(statements_.conclusion(choice, std::nullopt)));
      }
    }
    rules_ += fmt::format("{} ::= {} {}\n", gbnf::conclusion_rule, one_of(all),
                          R"(".\nResponse to user:")");
  }

  /// With which a choice may be compared.
  [[nodiscard]] std::vector<PolicyId> others(PolicyId choice) const {
    std::vector<PolicyId> all;
    if (statements_.is_alone()) {
      if (const auto next = statements_.next_best(choice)) {
        all.push_back(*next);
      }
      return all;
    }
    for (const PolicyId policy : manoeuvre::all_policies) {
      if (policy != choice && may_.test(manoeuvre::index(policy))) {
        all.push_back(policy);
      }
    }
    return all;
  }

  const Statements& statements_;
  std::vector<PolicyId> choices_;
  memory::Policies may_;
  std::string rules_;
  std::vector<std::string> known_;
};

}  // namespace

std::string reply_grammar(const preview::Situation& situation, std::string_view scene_part,
                          const std::optional<memory::Case>& nearest,
                          const std::optional<PolicyId>& choice) {
  const Statements statements(situation, scene_part, nearest);
  const memory::Policies may = admissible(situation.facts);
  std::vector<PolicyId> choices;
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (statements.end_of(policy).empty()) {
      return "";
    }
    if (may.test(manoeuvre::index(policy)) && policy == choice.value_or(policy)) {
      choices.push_back(policy);
    }
  }
  if (choices.empty()) {
    return "";
  }
  return Grammar(statements, std::move(choices), situation.scene_at_trigger.actors.size(), may)
      .text();
}

}  // namespace saca::language_model
