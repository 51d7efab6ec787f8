#include "saca/lab/runs/look_back.h"

#include <string_view>

#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/encounter/review.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/thinking/arbitration/event.h"

namespace saca::runs {

std::optional<Error> look_back(const encounter::Setup& setup, encounter::Record& record,
                               Story& story, const std::stop_token& stop) {
  if (setup.model != nullptr) {
    for (arbitration::Preview& preview : record.previews) {
      preview.retold = arbitration::retold(preview, *setup.model, *setup.clock, stop);
    }
  }
  const auto review = encounter::review(
      setup, record, [&](std::string_view said) { story.on_review(said); }, stop);
  if (!review.has_value()) {
    return review.error();
  }
  if (review.value()) {
    record.review = review.value();
    story.on_truth(record.review->truth);
    story.on_shown(record.review->shown);
    if (record.stored) {
      record.not_stored = encounter::keep_lesson(*setup.memory, *record.stored, *record.review);
    }
  }
  return std::nullopt;
}

std::optional<Error> look_back_until_interrupted(const encounter::Setup& setup,
                                                 encounter::Record& record, Story& story) {
  const long_work::InterruptStop interrupt;
  return look_back(setup, record, story, interrupt.token());
}

}  // namespace saca::runs
