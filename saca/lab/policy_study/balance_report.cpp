#include "saca/lab/policy_study/balance_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "saca/base/core/proportion.h"

namespace saca::policy_study {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 5> lesson_words{
    "the trigger never fires", "nothing has to be done", "nothing helps",
    "several are as good, the mildest is taken", "one alone is best"};
constexpr std::array<std::string_view, 5> lesson_keys{
    "never_triggers", "nothing_needed", "nothing_helps", "several_as_good", "one_alone"};

std::string percent(int hits, int count) {
  const Proportion share = proportion(hits, count);
  return fmt::format("{:5.1f} % ({:.1f} to {:.1f})", 100.0 * share.share, 100.0 * share.low,
                     100.0 * share.high);
}

}  // namespace

std::string text_of(const eval::Balance& balance) {
  std::string text = fmt::format("{} encounters\n", balance.count);
  for (std::size_t i = 0; i < lesson_words.size(); ++i) {
    text +=
        fmt::format("  {:42} {}\n", lesson_words[i], percent(balance.lessons[i], balance.count));
  }
  text += "\npolicy    strictly best             median margin   best, ties to the milder\n";
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const std::size_t i = manoeuvre::index(policy);
    text += fmt::format("{} {:6}  {:24}  {:13.4f}   {}\n", i, name(policy),
                        percent(balance.alone[i], balance.count), balance.margin[i],
                        percent(balance.best[i], balance.count));
  }
  return text;
}

json json_of(const eval::Balance& balance, const std::string& suite) {
  json figures;
  const std::string head = "balance." + suite + ".";
  const auto add = [&](const std::string& name, int hits) {
    const Proportion share = proportion(hits, balance.count);
    figures[head + name] = share.share;
    figures[head + name + ".lo"] = share.low;
    figures[head + name + ".hi"] = share.high;
  };
  for (std::size_t i = 0; i < lesson_keys.size(); ++i) {
    add(fmt::format("{}_share", lesson_keys[i]), balance.lessons[i]);
  }
  double least = 1.0;
  for (std::size_t i = 0; i < manoeuvre::num_policies; ++i) {
    add(fmt::format("strict_share.p{}", i), balance.alone[i]);
    add(fmt::format("best_share.p{}", i), balance.best[i]);
    figures[head + fmt::format("margin.p{}", i)] = balance.margin[i];
    if (manoeuvre::all_policies[i] != manoeuvre::PolicyId::no_intervention) {
      least = std::min(least, proportion(balance.alone[i], balance.count).share);
    }
  }
  figures[head + "least_strict_share"] = least;
  figures[head + "n"] = balance.count;
  return figures;
}

}  // namespace saca::policy_study
