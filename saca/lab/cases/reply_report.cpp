#include "saca/lab/cases/reply_report.h"

#include <fmt/core.h>

#include <vector>

#include "saca/lab/eval/estimate_text.h"
#include "saca/thinking/language_model/retelling.h"

namespace saca::cases {

using eval::add_estimate;
using eval::with_interval;
using nlohmann::json;

namespace {

/// Of an even number the upper one.
int median_of(const std::vector<int>& sorted) {
  return sorted[sorted.size() / 2];
}

std::string choices_text(const ReplyScore& score) {
  std::string text =
      fmt::format("{:42} {:>22} {:>12} {:>24} {:>24}\n", "choice", "best of admissible, %",
                  "admissible,%", "regret", "harm above the rule's");
  for (const ReplyChoice& one : score.choices) {
    text += fmt::format("{:42} {:>22} {:12.1f} {:>24} {:>24}\n", one.title,
                        with_interval(one.best_within, 1, 100.0), 100.0 * one.admissible.value,
                        with_interval(one.regret, 4), with_interval(one.above_rule, 4));
  }
  return text;
}

}  // namespace

json score_json(const ReplyScore& score, std::size_t failed) {
  json out{{"eval.num_examples", score.examples},
           {"eval.num_known", score.known},
           {"eval.num_failed", failed},
           {"eval.ended", score.ended},
           {"eval.text_and_answer_agree", score.agrees},
           {"eval.statements_checked", score.statements},
           {"eval.true_statements", score.true_statements},
           {"eval.true_replies", score.true_replies},
           {"eval.unfounded", score.unfounded},
           {"eval.shown", score.shown},
           {"eval.shown_in_part", score.shown_in_part},
           {"eval.shown_at_last", score.shown_at_last},
           {"eval.tokens.p50", median_of(score.tokens)},
           {"eval.tokens.max", score.tokens.back()}};
  add_estimate(out, "eval.twins.needless", score.needless);
  for (const ReplyChoice& one : score.choices) {
    const std::string key = fmt::format("eval.{}.", one.key);
    add_estimate(out, key + "best_within", one.best_within);
    add_estimate(out, key + "admissible", one.admissible);
    add_estimate(out, key + "harm", one.harm);
    add_estimate(out, key + "regret", one.regret);
    add_estimate(out, key + "above_rule", one.above_rule);
  }
  if (score.calibration) {
    out["eval.temperature"] = score.calibration->temperature;
    out["eval.log_loss"] = score.calibration->log_loss_now;
    out["eval.log_loss_at_temperature"] = score.calibration->log_loss;
  }
  return out;
}

std::string score_text(const ReplyScore& score, const std::string& set, const std::string& model) {
  std::string text =
      fmt::format("{} examples of the {} set, {}; of {} the harm of every policy is known\n\n",
                  score.examples, set, model, score.known);
  text += choices_text(score);
  text += fmt::format(
      "\nThe rule: AEB where it is admissible, else the mildest. In twins, where nothing has to be "
      "done, the model\nintervenes in {} %.\n\n{:.1f} % of the replies end by themselves, of {} "
      "tokens (median; at most {}); {:.1f} % conclude as they answer.\n{:.1f} statements of each "
      "can be checked, {:.1f} % of them are true; in {:.1f} % of the replies all are; {:.1f} % of "
      "the choices\nrest on something false. As the reason {:.1f} % are shown as they are, {:.1f} "
      "% without what does not hold,\n{:.1f} % where the model may try {} times; in place of the "
      "others the figures are told.\n",
      with_interval(score.needless, 1, 100.0), 100.0 * score.ended, median_of(score.tokens),
      score.tokens.back(), 100.0 * score.agrees, score.statements, 100.0 * score.true_statements,
      100.0 * score.true_replies, 100.0 * score.unfounded, 100.0 * score.shown,
      100.0 * score.shown_in_part, 100.0 * score.shown_at_last, language_model::most_tries);
  if (score.calibration) {
    text += fmt::format("Temperature: {:.2f} (log loss {:.3f}, as it is {:.3f}; {} examples)\n",
                        score.calibration->temperature, score.calibration->log_loss,
                        score.calibration->log_loss_now, score.calibration->count);
  }
  return text;
}

}  // namespace saca::cases
