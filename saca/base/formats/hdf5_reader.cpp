#include "saca/base/formats/hdf5_reader.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "saca/base/formats/hdf5_handle.h"

namespace saca::formats {
namespace {

constexpr hsize_t deflates_at_most = 1100;  // to one byte; zlib: 1032

std::string without_padding(std::string text) {
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}

std::string attribute_part(const std::string& object, const char* name) {
  return fmt::format("attribute {}/{}", object, name);
}
std::string set_part(const char* name) {
  return fmt::format("data set {}", name);
}

}  // namespace

struct Hdf5Reader::State {
  State(std::string source_name, const std::filesystem::path& path)
      : source(std::move(source_name)),
        file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose) {}

  void reject(const std::string& part, const std::string& message) {
    if (!problem) {
      problem = Error{Error::Code::malformed, fmt::format("{}: {}: {}", source, part, message)};
    }
  }
  void reject(const std::string& part, const std::string& wanted, const std::string& came) {
    reject(part, fmt::format("want {}, got {}", wanted, came));
  }

  /// An attribute of the right kind, holding one value; else it is rejected.
  Hdf5Handle attribute(const std::string& object, const char* name, H5T_class_t kind,
                       const std::string& wanted) {
    Hdf5Handle found(
        problem ? H5I_INVALID_HID
                : H5Aopen_by_name(file.id(), object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    const std::string part =
        object == "." ? fmt::format("attribute {}", name) : attribute_part(object, name);
    if (!found.good()) {
      reject(part, wanted, "none");
      return found;
    }
    const Hdf5Handle space(H5Aget_space(found.id()), H5Sclose);
    const Hdf5Handle type(H5Aget_type(found.id()), H5Tclose);
    if (H5Sget_simple_extent_npoints(space.id()) != 1 || H5Tget_class(type.id()) != kind ||
        (kind == H5T_STRING && H5Tis_variable_str(type.id()) != 0)) {
      reject(part, wanted, "another type or shape");
    }
    return found;
  }

  /// A data set that is there; else it is rejected.
  Hdf5Handle data_set(const char* name) {
    Hdf5Handle set(problem ? H5I_INVALID_HID : H5Dopen2(file.id(), name, H5P_DEFAULT), H5Dclose);
    if (!set.good()) {
      reject(set_part(name), "one", "none");
    }
    return set;
  }

  Hdf5Session session;
  std::string source;
  std::optional<Error> problem;
  Hdf5Handle access = without_lock();
  Hdf5Handle file;
};

Hdf5Reader::Hdf5Reader(std::string source, const std::filesystem::path& path)
    : state_(std::make_unique<State>(std::move(source), path)) {
  if (!state_->file.good()) {
    reject("file", "HDF5", "what HDF5 cannot open");
  }
}
Hdf5Reader::~Hdf5Reader() = default;

double Hdf5Reader::number(const std::string& object, const char* name) {
  double value = 0.0;
  const Hdf5Handle found = state_->attribute(object, name, H5T_FLOAT, "a number");
  if (!problem() && H5Aread(found.id(), H5T_NATIVE_DOUBLE, &value) < 0) {
    reject(attribute_part(object, name), "a number", "what cannot be read");
  }
  return value;
}

std::int32_t Hdf5Reader::whole(const std::string& object, const char* name, std::int32_t least,
                               std::int32_t most) {
  std::int32_t value = least;
  const std::string wanted = fmt::format("a whole number in [{}, {}]", least, most);
  const Hdf5Handle found = state_->attribute(object, name, H5T_INTEGER, wanted);
  if (!problem() &&
      (H5Aread(found.id(), H5T_NATIVE_INT32, &value) < 0 || value < least || value > most)) {
    reject(attribute_part(object, name), wanted, fmt::format("{}", value));
  }
  return problem() ? least : value;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const char* name) {
  const Hdf5Handle found = state_->attribute(object, name, H5T_STRING, "a text");
  if (problem()) {
    return {};
  }
  const Hdf5Handle type(H5Aget_type(found.id()), H5Tclose);
  std::string value(H5Tget_size(type.id()), '\0');
  if (H5Aread(found.id(), type.id(), value.data()) < 0) {
    reject(attribute_part(object, name), "a text", "what cannot be read");
  }
  return without_padding(std::move(value));
}

bool Hdf5Reader::has(const char* name) const {
  return !problem() && H5Lexists(state_->file.id(), name, H5P_DEFAULT) > 0;
}

std::string Hdf5Reader::text(const char* name) {
  const Hdf5Handle set = state_->data_set(name);
  if (problem()) {
    return {};
  }
  const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
  const bool right = H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) == 0 &&
                     H5Sget_simple_extent_npoints(space.id()) == 1;
  std::string value(right ? H5Tget_size(type.id()) : 1, '\0');
  if (!right || H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) {
    reject(set_part(name), "a text", "something else");
  }
  return without_padding(std::move(value));
}

std::vector<std::size_t> Hdf5Reader::extents(const char* name) {
  const Hdf5Handle set = state_->data_set(name);
  if (problem()) {
    return {};
  }
  const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) {
    H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  }
  return {shape.begin(), shape.end()};
}

template <class Real>
bool Hdf5Reader::is_of(const char* name) const {
  if (!has(name)) {
    return false;
  }
  const Hdf5Handle set(H5Dopen2(state_->file.id(), name, H5P_DEFAULT), H5Dclose);
  const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
  return H5Tequal(type.id(), file_type<Real>()) > 0;
}

template <class Real>
void Hdf5Reader::want_numbers(const char* name, const std::vector<std::size_t>& extents) {
  const std::vector<std::size_t> came = this->extents(name);
  if (problem()) {
    return;
  }
  const std::string wanted = fmt::format("{} numbers", fmt::join(extents, " x "));
  if (came != extents) {
    reject(set_part(name), wanted,
           came.empty() ? "one value" : fmt::format("{}", fmt::join(came, " x ")));
  } else if (!is_of<Real>(name)) {
    reject(set_part(name), fmt::format("numbers of {} bytes", sizeof(Real)), "another type");
  } else {
    hsize_t kept =
        deflates_at_most * H5Dget_storage_size(state_->data_set(name).id()) / sizeof(Real);
    for (const std::size_t extent : extents) {
      kept /= std::max<std::size_t>(extent, 1);
    }
    if (kept == 0) {
      reject(set_part(name), wanted, "fewer bytes");
    }
  }
}

template <class Real>
void Hdf5Reader::numbers(const char* name, const std::vector<std::size_t>& extents,
                         const std::vector<Real*>& parts, Numbers allowed) {
  Hdf5Parts along(extents, parts.size());
  want_numbers<Real>(name, extents);
  if (problem()) {
    return;
  }
  const Hdf5Handle set = state_->data_set(name);
  const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
  const Hdf5Handle part_space = along.space();
  for (Real* const part : parts) {
    if (!along.select_next(space) || H5Dread(set.id(), memory_type<Real>(), part_space.id(),
                                             space.id(), H5P_DEFAULT, part) < 0) {
      reject(set_part(name), "numbers", "what cannot be read");
      return;
    }
    const Real* const end = part + along.size();
    const Real* const bad =
        std::find_if<const Real*>(part, end, [](Real x) { return !std::isfinite(x); });
    if (allowed == Numbers::finite && bad != end) {
      reject(set_part(name), "finite numbers", fmt::format("{} at {}", *bad, bad - part));
      return;
    }
  }
}

void Hdf5Reader::reject(const std::string& part, const std::string& message) {
  state_->reject(part, message);
}
void Hdf5Reader::reject(const std::string& part, const std::string& wanted,
                        const std::string& came) {
  state_->reject(part, wanted, came);
}
const std::optional<Error>& Hdf5Reader::problem() const {
  return state_->problem;
}

template bool Hdf5Reader::is_of<float>(const char*) const;
template bool Hdf5Reader::is_of<double>(const char*) const;
template void Hdf5Reader::want_numbers<float>(const char*, const std::vector<std::size_t>&);
template void Hdf5Reader::want_numbers<double>(const char*, const std::vector<std::size_t>&);
template void Hdf5Reader::numbers(const char*, const std::vector<std::size_t>&,
                                  const std::vector<float*>&, Numbers);
template void Hdf5Reader::numbers(const char*, const std::vector<std::size_t>&,
                                  const std::vector<double*>&, Numbers);

}  // namespace saca::formats
