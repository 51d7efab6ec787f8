#include "saca/lab/banks/bank_contents.h"

#include <fmt/core.h>

#include "saca/onboard/manoeuvre/plan.h"

namespace saca::banks {
namespace {

/// "2 own, 3 simulation"
std::string counts_text(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [what, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  }
  return text;
}

}  // namespace

nlohmann::json list_json(std::span<const memory::Case> cases) {
  nlohmann::json list = nlohmann::json::array();
  for (const memory::Case& one : cases) {
    list.push_back({{"id", one.id},
                    {"source", one.source},
                    {"policy", manoeuvre::index(one.plan.policy)},
                    {"best", manoeuvre::index(one.best)},
                    {"harm", one.harm},
                    {"best_harm", one.best_harm},
                    {"collision_loss", one.collision_loss},
                    {"review", one.review},
                    {"origin", name(one.origin)},
                    {"trust", name(one.trust)},
                    {"count", one.count}});
  }
  return list;
}

std::string list_text(std::span<const memory::Case> cases, const std::string& name) {
  if (cases.empty()) {
    return fmt::format("{}: no cases yet\n", name);
  }
  std::string text;
  for (const memory::Case& one : cases) {
    const std::string mark =
        one.trust == memory::Trust::trusted ? "" : fmt::format("  [{}]", memory::name(one.trust));
    text += fmt::format("{:5}  {:24} did {} best {}  {}{}\n", one.id, one.source,
                        manoeuvre::index(one.plan.policy), manoeuvre::index(one.best), one.review,
                        mark);
  }
  return text;
}

Result<BankContents> contents_of(const ReadBank& bank) {
  const auto digest = bank.store.digest();
  if (!digest.has_value()) {
    return digest.error();
  }
  BankContents contents{.name = bank.store.name(),
                        .cases = bank.cases.size(),
                        .digest = fmt::format("{:016x}", digest.value()),
                        .origins = {},
                        .trust = {},
                        .best = {}};
  for (const memory::Case& one : bank.cases) {
    ++contents.origins[std::string(name(one.origin))];
    ++contents.trust[std::string(name(one.trust))];
    ++contents.best[std::string(name(one.best))];
  }
  return contents;
}

nlohmann::json json_of(const BankContents& contents) {
  return {{"schema", "saca.memory_bank/1"}, {"file", contents.name},
          {"cases", contents.cases},        {"digest", contents.digest},
          {"origins", contents.origins},    {"trust", contents.trust},
          {"best", contents.best}};
}

std::string text_of(const BankContents& contents) {
  std::string text = fmt::format("{}: {} cases, all whole; digest {}\n", contents.name,
                                 contents.cases, contents.digest);
  if (contents.cases > 0) {
    text += fmt::format("from   {}\ntrust  {}\nbest   {}\n", counts_text(contents.origins),
                        counts_text(contents.trust), counts_text(contents.best));
  }
  return text;
}

}  // namespace saca::banks
