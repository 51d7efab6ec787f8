#include "saca/thinking/language_model/retelling.h"

#include <chrono>
#include <utility>

#include "saca/thinking/language_model/reply.h"

namespace saca::language_model {
namespace {

constexpr auto patience = std::chrono::minutes(2);

}  // namespace

Result<Explanation> told_again(LanguageModel& model, const Clock& clock, const std::string& prompt,
                               Explanation first,
                               const std::function<Explanation(std::string_view)>& shown_by,
                               AskOptions options) {
  Explanation shown = std::move(first);
  while (shown.from == Explanation::From::facts && shown.tries < most_tries) {
    options.sampling_seed = shown.tries;
    const auto replies = model.ask(
        {prompt}, clock.now() + patience, [](const Progress&) {}, options);
    if (options.stop.stop_requested()) {
      break;
    }
    const bool nonsense = !replies.has_value() && replies.error().code == Error::Code::malformed;
    if (!replies.has_value() && !nonsense) {
      return replies.error();
    }
    const int tries = shown.tries + 1;
    if (!nonsense) {
      shown = shown_by(finished_part(replies.value().front()));
    }
    shown.tries = tries;
  }
  return shown;
}

}  // namespace saca::language_model
