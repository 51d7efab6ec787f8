#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::formats {

/// Which numbers a data set may hold.
enum class Numbers : std::uint8_t { finite, all };

/// Reads an HDF5 file strictly, as `Document` does TOML: the first thing that is wrong is
/// remembered as "source: part: want this, got that", and nothing is read any more; what is
/// returned then is of the right kind. Other threads wait as for `Hdf5Writer`.
class Hdf5Reader {
 public:
  /// @param source  name for messages, usually the path
  Hdf5Reader(std::string source, const std::filesystem::path& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// An attribute; it must be there.
  /// @param object  a group or data set; ".": the file
  [[nodiscard]] double number(const std::string& object, const char* name);
  /// Likewise in [least, most].
  [[nodiscard]] std::int32_t whole(const std::string& object, const char* name, std::int32_t least,
                                   std::int32_t most);
  [[nodiscard]] std::string text_attribute(const std::string& object, const char* name);

  /// Whether there is such a data set or group; false after a problem.
  [[nodiscard]] bool has(const char* name) const;
  /// A data set of one text; it must be there.
  [[nodiscard]] std::string text(const char* name);
  /// Those of a data set, which must be there; empty: it holds one value.
  [[nodiscard]] std::vector<std::size_t> extents(const char* name);
  /// Whether a data set is there and of this kind of numbers.
  template <class Real>
  [[nodiscard]] bool is_of(const char* name) const;
  /// Rejects the file unless this data set has these extents, none of them 0, is of this kind, and
  /// as many numbers can be in there: before memory is taken for them.
  template <class Real>
  void want_numbers(const char* name, const std::vector<std::size_t>& extents);
  /// Numbers, parts along the first axis one after another.
  /// @param allowed  others are rejected
  /// @throws ContractViolation  as Hdf5Writer::numbers
  template <class Real>
  void numbers(const char* name, const std::vector<std::size_t>& extents,
               const std::vector<Real*>& parts, Numbers allowed = Numbers::finite);

  /// Remembers what is wrong, unless something was before: for rules that join several parts.
  void reject(const std::string& part, const std::string& message);
  void reject(const std::string& part, const std::string& wanted, const std::string& came);
  /// What was wrong first, Error::Code::malformed; nullopt when all is well.
  [[nodiscard]] const std::optional<Error>& problem() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template bool Hdf5Reader::is_of<float>(const char*) const;
extern template bool Hdf5Reader::is_of<double>(const char*) const;
extern template void Hdf5Reader::want_numbers<float>(const char*, const std::vector<std::size_t>&);
extern template void Hdf5Reader::want_numbers<double>(const char*, const std::vector<std::size_t>&);
extern template void Hdf5Reader::numbers(const char*, const std::vector<std::size_t>&,
                                         const std::vector<float*>&, Numbers);
extern template void Hdf5Reader::numbers(const char*, const std::vector<std::size_t>&,
                                         const std::vector<double*>&, Numbers);

}  // namespace saca::formats
