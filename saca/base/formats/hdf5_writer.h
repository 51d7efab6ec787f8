#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace saca::formats {

/// Builds an HDF5 file in memory; remembers whether all went well. The same calls make the same
/// bytes. It makes the writers and readers of other threads wait until it ends, because the library
/// works for one at a time; a thread must not have two of them at once.
class Hdf5Writer {
 public:
  /// @param growth  bytes of memory at a time: where the size is about known, growing by it spares
  ///                copies
  explicit Hdf5Writer(std::size_t growth = std::size_t{1} << 22);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void group(const std::string& name);
  /// @param object  a group or data set that was made before; ".": the file
  void attribute(const std::string& object, const char* name, double value);
  void attribute(const std::string& object, const char* name, std::int32_t value);
  void attribute(const std::string& object, const char* name, const std::string& text);
  /// A data set of one text.
  void text(const char* name, const std::string& text);
  /// A compressed data set whose parts along the first axis are written one after another.
  ///
  /// @tparam Real    float or double
  /// @param extents  slowest axis first, all >= 1
  /// @param parts    of equal size, together all numbers; at least one
  /// @throws ContractViolation  if the first extent cannot be divided among the parts
  template <class Real>
  void numbers(const char* name, const std::vector<std::size_t>& extents,
               const std::vector<const Real*>& parts);

  /// All that was written, until more is; nullopt: something went wrong.
  [[nodiscard]] std::optional<std::string_view> bytes();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template void Hdf5Writer::numbers(const char*, const std::vector<std::size_t>&,
                                         const std::vector<const float*>&);
extern template void Hdf5Writer::numbers(const char*, const std::vector<std::size_t>&,
                                         const std::vector<const double*>&);

}  // namespace saca::formats
