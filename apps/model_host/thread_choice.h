#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "saca/thinking/language_model/language_model.h"

namespace saca::model_host {

/// How many threads to compute with. All are fastest where nobody else wants the cores; else they
/// wait for each other hundreds of times in each step, and one alone is several times as fast.
/// Which holds is told beforehand by how many cores are free (`FreeCores`), and seen at once from
/// what prompts and steps take and how much of that time the threads were computing: a machine may
/// be slow although nobody disturbs it.
class ThreadChoice {
 public:
  /// @param all        > 0
  /// @param gives_way  whether one thread may be chosen; the last bits of an answer differ with it
  ThreadChoice(int all, bool gives_way) : all_(all), gives_way_(gives_way && all > 1) {}

  [[nodiscard]] int threads() const { return alone_ ? 1 : all_; }
  [[nodiscard]] bool gives_way() const { return gives_way_; }

  /// For the next prompts and steps.
  void take_all() {
    rehearses_alone_ = false;
    alone_ = false;
    lost_ = 0.0;
  }
  /// To learn what one thread takes: until `take_all`, however many cores are free.
  void take_one() {
    rehearses_alone_ = true;
    alone_ = gives_way_;
  }

  /// Others left so many cores of late: all threads where that is enough for them, else one.
  void note_free(double cores) {
    if (rehearses_alone_) {
      return;
    }
    alone_ = gives_way_ && cores < static_cast<double>(all_) - half_a_core;
    lost_ = 0.0;
  }

  /// A prompt was read, at so much time for each of its tokens [s].
  /// @param computing  processor time over the time that all threads had, in [0, 1]: less than 1
  ///                   where others had the cores. Who waits for another thread computes, too
  void note_prompt(double token_cost, double computing) {
    if (alone_) {
      return;
    }
    alone_ = gives_way_ && computing < undisturbed && token_cost > dear_prompt * prompt_token_;
    prompt_token_ = std::min(prompt_token_, token_cost);
  }

  /// A step made one token for each of `scenes` [s].
  /// @param computing  as of a prompt
  /// @return           whether one thread alone goes on from here
  bool note_step(std::size_t scenes, double cost, double computing) {
    double& alone = step_alone_.at(scenes - 1);
    if (alone_) {
      alone = std::min(alone, cost);
      return false;
    }
    const double more = cost - alone;
    lost_ = std::max(0.0, lost_ + (computing < undisturbed ? more : std::min(more, 0.0)));
    alone_ = gives_way_ && lost_ > most_lost * alone;
    return alone_;
  }

  /// What a step takes one thread, at best; infinity while none was measured [s].
  [[nodiscard]] double step_alone(std::size_t scenes) const { return step_alone_.at(scenes - 1); }

 private:
  // Measured, two threads and cores: with one other process a token of a prompt takes at least
  // twice as long as with none; a step takes three times as long as one thread takes, or more. On
  // an idle machine a prompt may take 1.6 times as long, a single step three times.
  static constexpr double dear_prompt = 1.8;
  // Likewise: of their time threads computed in 0.87 to 1.00 where nobody else was, in 0.50 to 0.63
  // beside one other process, in steps of three scenes in up to 0.71.
  static constexpr double undisturbed = 0.75;
  static constexpr double most_lost = 6.0;  // against one thread, in steps of that
  static constexpr double half_a_core = 0.5;
  static constexpr double never = std::numeric_limits<double>::infinity();

  int all_;
  bool gives_way_;
  bool alone_ = false;
  bool rehearses_alone_ = false;
  double lost_ = 0.0;            ///< by steps of all threads, since they last gained [s]
  double prompt_token_ = never;  ///< at best, with all threads [s]
  std::array<double, language_model::most_scenes> step_alone_{never, never, never};
};

}  // namespace saca::model_host
