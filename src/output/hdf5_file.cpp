#include "output/hdf5_file.hpp"

#include <hdf5.h>

#include <type_traits>
#include <utility>

#include "base/errors.hpp"

namespace ejecta {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

namespace {

/// HDF5 cannot close a file that it cannot write. At the end of the process or, if it began after MPI (which comes with
/// ParaView), at the end of that it would try once more and fall over it: so it begins first, and never ends.
[[maybe_unused]] const herr_t begun_for_good = (H5dont_atexit(), H5open());

/// HDF5 prints a stack of messages by itself unless told not to.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

std::int64_t open_file(const std::filesystem::path& file, Hdf5File::Mode mode) {
  const Quiet quiet;
  if (mode == Hdf5File::Mode::read) return H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  errno = 0;
  const Hdf5Handle layout(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(layout.id(), hdf5_user_block);
  return H5Fcreate(file.c_str(), H5F_ACC_TRUNC, layout.id(), H5P_DEFAULT);
}

/// A zero-terminated UTF-8 text of fixed length.
std::int64_t text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, length + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

}  // namespace

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
Hdf5Handle::~Hdf5Handle() {
  const Quiet quiet;
  if (id_ >= 0) close_(id_);
}
int Hdf5Handle::close() { return close_(std::exchange(id_, -1)); }

Hdf5File::Hdf5File(std::filesystem::path file, Mode mode)
    : path_(std::move(file)), mode_(mode), file_(open_file(path_, mode), H5Fclose) {
  if (file_.id() < 0)
    fail(mode == Mode::create ? "cannot be written"
                              : "is not a complete HDF5 file (missing, truncated or another format)");
}

void Hdf5File::fail(const std::string& what) const {
  if (mode_ == Mode::create) throw OutputError(path_);
  throw InputError(path_.string() + ": " + what);
}

Hdf5Handle Hdf5File::checked(std::int64_t id, Hdf5Handle::Close close, const std::string& what) const {
  if (id < 0) fail(what);
  return {id, close};
}

void Hdf5File::write_text(const std::string& name, const std::string& text) {
  const Quiet quiet;
  const std::string what = "cannot write text " + name;
  const Hdf5Handle type = checked(text_type(text.size()), H5Tclose, what);
  const Hdf5Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Hdf5Handle data =
      checked(H5Dcreate2(file_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
              H5Dclose, what);
  if (H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0 || H5Dflush(data.id()) < 0)
    fail(what);
}

std::string Hdf5File::read_text(const std::string& name) const {
  const Quiet quiet;
  const std::string what = "has no text " + name;
  const Hdf5Handle data = checked(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose, what);
  const Hdf5Handle type = checked(H5Dget_type(data.id()), H5Tclose, what);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) fail(what);
  std::string text(H5Tget_size(type.id()), '\0');
  if (H5Dread(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) fail("cannot read text " + name);
  return text.substr(0, text.find('\0'));
}

void Hdf5File::write_values(const std::string& name, const std::string& unit, std::int64_t type, const void* values,
                            std::size_t count) {
  const Quiet quiet;
  const std::string what = "cannot write data set " + name + " (is the disk full?)";
  const hsize_t extent = count;
  const Hdf5Handle space = checked(H5Screate_simple(1, &extent, nullptr), H5Sclose, what);
  const Hdf5Handle links = checked(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle data = checked(
      H5Dcreate2(file_.id(), name.c_str(), type, space.id(), links.id(), H5P_DEFAULT, H5P_DEFAULT), H5Dclose, what);
  if (count > 0 && H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail(what);
  const Hdf5Handle text = checked(text_type(unit.size()), H5Tclose, what);
  const Hdf5Handle scalar = checked(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Hdf5Handle attribute =
      checked(H5Acreate2(data.id(), "unit", text.id(), scalar.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  if (H5Awrite(attribute.id(), text.id(), unit.c_str()) < 0) fail(what);
  if (H5Dflush(data.id()) < 0) fail(what);  // closing would write the rest and could not complain
}

void Hdf5File::write(const std::string& name, const std::string& unit, std::span<const double> values) {
  write_values(name, unit, H5T_NATIVE_DOUBLE, values.data(), values.size());
}
void Hdf5File::write(const std::string& name, const std::string& unit, std::span<const std::int32_t> values) {
  write_values(name, unit, H5T_NATIVE_INT32, values.data(), values.size());
}

template <class T>
void Hdf5File::write_number(const std::string& name, std::int64_t type, T value) const {
  const Quiet quiet;
  const std::string what = "cannot write attribute " + name;
  const Hdf5Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Hdf5Handle attribute =
      checked(H5Acreate2(file_.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  if (H5Awrite(attribute.id(), type, &value) < 0) fail(what);
}

void Hdf5File::write_attribute(const std::string& name, double value) { write_number(name, H5T_NATIVE_DOUBLE, value); }
void Hdf5File::write_attribute(const std::string& name, std::int64_t value) {
  write_number(name, H5T_NATIVE_INT64, value);
}

void Hdf5File::close() {
  const Quiet quiet;
  if (H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) < 0 || file_.close() < 0) fail("cannot be written");
}

std::vector<std::string> Hdf5File::names(const std::string& group) const {
  const Quiet quiet;
  if (H5Lexists(file_.id(), group.c_str(), H5P_DEFAULT) <= 0) return {};
  const Hdf5Handle opened =
      checked(H5Gopen2(file_.id(), group.c_str(), H5P_DEFAULT), H5Gclose, "has no group " + group);
  std::vector<std::string> found;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Literate(opened.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &found) < 0) fail("cannot list group " + group);
  return found;
}

template <class T>
std::vector<T> Hdf5File::read_values(const std::string& name, std::int64_t type) const {
  const Quiet quiet;
  const Hdf5Handle data = checked(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose, "has no data set " + name);
  const Hdf5Handle space = checked(H5Dget_space(data.id()), H5Sclose, "cannot read data set " + name);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id())));
  if (!values.empty() && H5Dread(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail("cannot read data set " + name);
  return values;
}

std::vector<double> Hdf5File::read_doubles(const std::string& name) const {
  return read_values<double>(name, H5T_NATIVE_DOUBLE);
}
std::vector<std::int32_t> Hdf5File::read_integers(const std::string& name) const {
  return read_values<std::int32_t>(name, H5T_NATIVE_INT32);
}

std::string Hdf5File::unit(const std::string& name) const {
  const Quiet quiet;
  const Hdf5Handle data = checked(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose, "has no data set " + name);
  const std::string missing = "has no unit for data set " + name;
  const Hdf5Handle attribute = checked(H5Aopen(data.id(), "unit", H5P_DEFAULT), H5Aclose, missing);
  const Hdf5Handle type = checked(H5Aget_type(attribute.id()), H5Tclose, missing);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) fail(missing);
  std::string text(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0) fail(missing);
  return text.substr(0, text.find('\0'));
}

template <class T>
T Hdf5File::read_number(const std::string& name, std::int64_t type) const {
  const Quiet quiet;
  const Hdf5Handle attribute =
      checked(H5Aopen(file_.id(), name.c_str(), H5P_DEFAULT), H5Aclose, "has no attribute " + name);
  T value{};
  if (H5Aread(attribute.id(), type, &value) < 0) fail("cannot read attribute " + name);
  return value;
}

double Hdf5File::real_attribute(const std::string& name) const { return read_number<double>(name, H5T_NATIVE_DOUBLE); }
std::int64_t Hdf5File::integer_attribute(const std::string& name) const {
  return read_number<std::int64_t>(name, H5T_NATIVE_INT64);
}

}  // namespace ejecta
