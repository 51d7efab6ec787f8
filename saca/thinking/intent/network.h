#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/thinking/intent/crf.h"
#include "saca/thinking/intent/features.h"

namespace saca::intent {

/// How far ahead intentions are told [s]: now, and later.
constexpr std::array<double, 3> horizons{0.0, 0.5, 1.0};
constexpr std::size_t num_horizons = horizons.size();

/// Emissions of all horizons at one instant.
using Emissions = std::array<Scores, num_horizons>;

/// Rows of weights in tiles, so that a tile of sums stays in registers; the last tile is filled
/// with zeros.
struct DenseLayer {
  std::size_t num_columns = 0;
  std::vector<float> weight;  ///< [tile][column][row in tile]
  std::vector<float> bias;

  /// From the tensors `name` + ".weight" (rows x columns) and ".bias" (rows).
  /// @return  Error::Code::malformed, as formats::take
  [[nodiscard]] static Result<DenseLayer> from(const formats::Tensors& tensors,
                                               const std::string& name, std::size_t rows,
                                               std::size_t columns, std::string_view source);
};

/// One LSTM from features to what an output layer reads.
///
///   u = tanh(W_in f + b_in)
///   h, c = LSTM(u, h, c)
///
/// It looks at the world and at its mirror image, so that nothing learnt on one side need be
/// missing on the other. Source of the cell: Gers, Schmidhuber, Cummins, Learning to forget, Neural
/// Computation 12 (2000).
class Encoder {
 public:
  static constexpr std::size_t width = 48;  ///< of u, h and c

  /// What it remembers of one road user: fixed in size.
  struct State {
    std::array<std::array<float, width>, 2> hidden{};  ///< of the world, and of its mirror image
    std::array<std::array<float, width>, 2> cell{};
  };
  /// [h; u] of the world, and of its mirror image.
  using Encoded = std::array<std::array<float, 2 * width>, 2>;

  /// From the tensors `prefix` + "input.weight" (width x num_features), "input.bias" (width),
  /// "lstm.weight" (4 width x 2 width, columns u, then h; gates in, forget, cell, out) and
  /// "lstm.bias" (4 width).
  /// @return  Error::Code::malformed, as formats::take
  [[nodiscard]] static Result<Encoder> from(const formats::Tensors& tensors,
                                            const std::string& prefix, std::string_view source);

  /// One step; allocates nothing.
  [[nodiscard]] Encoded step(const Features& features, State& state) const;

  /// Its weights, to name them.
  void add_to(Fnv& hash) const;

 private:
  DenseLayer input_;
  DenseLayer lstm_;
};

/// An encoder with an output layer for emissions: e = W_out [h; u] + b_out, the mean of what it
/// sees in the world and in its mirror image: exactly symmetric.
class Network {
 public:
  static constexpr std::size_t width = Encoder::width;
  static constexpr std::size_t num_emissions = num_horizons * num_classes;
  using State = Encoder::State;

  /// From the tensors of an encoder, `prefix` + "output.weight" (num_emissions x 2 width, columns
  /// h, then u) and "output.bias".
  /// @return  Error::Code::malformed, as formats::take
  [[nodiscard]] static Result<Network> from(const formats::Tensors& tensors,
                                            const std::string& prefix, std::string_view source);

  /// One step; allocates nothing.
  [[nodiscard]] Emissions step(const Features& features, State& state) const;

  /// Its weights, to name them.
  void add_to(Fnv& hash) const;

 private:
  Encoder encoder_;
  DenseLayer output_;
};

/// The same emissions seen in a mirror: left is right.
[[nodiscard]] Scores mirrored(const Scores& scores);

}  // namespace saca::intent
