#pragma once

#include <cstdio>
#include <mutex>

#include "saca/loop/encounter.h"

namespace saca::app {

/// Tells an encounter on a stream while it happens.
class Story final : public loop::Listener {
 public:
  /// @param colour  whether the stream understands terminal colours
  Story(std::FILE* stream, bool colour) : stream_(stream), colour_(colour) {}

  void on_event(const decide::Event& event) override;
  void on_reasoning(std::int32_t preview, std::string_view text) override;

  void headline(const sim::Scenario& scenario, const loop::Setup& setup);
  void ending(const sim::Scenario& scenario, const loop::Record& record);
  /// The model looking back, piece by piece.
  void on_review(std::string_view text);

 private:
  std::FILE* stream_;
  bool colour_;
  bool reviewing_ = false;
  std::mutex lock_;
};

}  // namespace saca::app
