#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/verification/npz.h"

/// The value network that the authors of the paper published: for comparison only, nothing is
/// decided by it.
///
/// Four inputs, two hidden layers of rectified sums, one output: a value [m] that takes the place
/// of V. Its authors make a risk of it by clip((V + 30) / 30, 0, 1): 1 from V = 0 on, so V >= 0 is
/// read as unsafe, as here.
namespace saca::verification {

/// What the network is asked about: the ego relative to an obstacle at rest, in the obstacle's
/// frame.
struct AuthorsState {
  double x = 0.0;      ///< of the ego less that of the obstacle; behind it is < 0 [m]
  double y = 0.0;      ///< the network reads |y| [m]
  double yaw = 0.0;    ///< the network reads |yaw| [rad]
  double speed = 0.0;  ///< [m/s]
};

/// Whether its inputs are all in [0, 1], for which they are scaled: x in [-50, 0] m, |y| <= 8 m,
/// |yaw| <= 40 deg, speed in [0, 18] m/s. Nothing published says what it was trained on.
[[nodiscard]] bool in_authors_range(const AuthorsState& state);

class AuthorsNetwork {
 public:
  /// @param arrays  kernels (inputs x outputs) and biases, by the names that their file has
  /// @param source  where they are from, for messages
  /// @return        Error::Code::malformed: an array is missing, is of another shape or is unknown
  [[nodiscard]] static Result<AuthorsNetwork> from(const std::map<std::string, NpyArray>& arrays,
                                                   const std::string& source);

  /// Values in single precision, as the network was trained [m].   (as many as states)
  [[nodiscard]] std::vector<double> values(std::span<const AuthorsState> states) const;

 private:
  /// out = in x kernel + bias
  struct Layer {
    std::size_t inputs = 0, outputs = 0;
    std::vector<float> kernel;  // (inputs x outputs)
    std::vector<float> bias;    // (outputs)
  };

  std::vector<Layer> layers_;
};

/// @return  Error::Code::unreadable or malformed, naming the file
[[nodiscard]] Result<AuthorsNetwork> read_authors_network(const std::filesystem::path& path);

}  // namespace saca::verification
