#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/encounter.h"

/// What one run of an encounter leaves and tells, beside the record: its story while it happens,
/// its files, its memory, and the same steps worked out again from a tape.
namespace saca::runs {

/// Tells an encounter on a file that is open, while it happens.
///
/// Waits for whoever reads it, as for a full pipe or a terminal that is held, but no longer than
/// `patience`: then, or where it cannot be written, the rest is left out, and `problem` says why.
/// SIGPIPE is to be caught.
class Story final : public encounter::Listener {
 public:
  static constexpr int patience = 10;  ///< [s]

  /// @param file    its descriptor; nullopt: nothing is printed
  /// @param colour  whether it understands terminal colours
  Story(std::optional<int> file, bool colour) : file_(file), colour_(colour) {}

  void on_event(const arbitration::Event& event) override;
  void on_reasoning(std::int32_t preview, std::string_view text) override;

  /// Does not wait: what cannot be written now stands before the first event.
  void headline(const scenario::Scenario& scenario, const encounter::Setup& setup);
  /// @param in_short  what came, what was weighed and why this was done, in sentences
  void ending(const scenario::Scenario& scenario, const encounter::Record& record,
              const std::vector<std::string>& in_short);
  /// The model looking back, piece by piece.
  void on_review(std::string_view text);
  /// What of that is false.
  void on_truth(const language_model::Truth& truth);
  /// What is shown of it in the end, where the model tried again.
  void on_shown(const language_model::Explanation& shown);
  /// Where the report lies.
  void on_report(const std::string& file);

  /// Why not everything was printed.
  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }

 private:
  void say(const std::string& text);
  void write_waiting(int seconds);

  std::optional<int> file_;
  bool colour_;
  bool reviewing_ = false;
  std::string waiting_;  ///< said, and not written yet
  std::optional<Error> problem_;
};

}  // namespace saca::runs
