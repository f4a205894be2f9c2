#include "analysis/checkpoint.h"

#include "base/error.h"

#include <hdf5.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace plumbline::analysis
{
  namespace
  {
    namespace fs = std::filesystem;

    /// What HDF5 could not do; its own words are not for users.
    struct Failure : std::runtime_error
    {
      using std::runtime_error::runtime_error;
    };

    template <typename Result>
    Result require(Result result, const char *what)
    {
      if (result < 0)
        throw Failure(what);
      return result;
    }

    /// An identifier of HDF5, closed at the end.
    class Handle
    {
    public:
      Handle(hid_t id, herr_t (*close)(hid_t), const char *what)
          : id_(require(id, what)), close_(close)
      {
      }
      Handle(const Handle &) = delete;
      Handle &operator=(const Handle &) = delete;
      ~Handle()
      {
        if (id_ >= 0)
          close_(id_);
      }
      operator hid_t() const { return id_; }

      /// Now, to know whether all of it was written.
      void close(const char *what)
      {
        const hid_t id = id_;
        id_ = -1;
        require(close_(id), what);
      }

    private:
      hid_t id_;
      herr_t (*close_)(hid_t);
    };

    /// While it lives HDF5 prints nothing; nor at the end of the program about what it holds of
    /// files that it could not read or write: all that is ours is closed by then.
    class Silence
    {
    public:
      Silence()
      {
        [[maybe_unused]] static const herr_t once = H5dont_atexit();
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }
      Silence(const Silence &) = delete;
      Silence &operator=(const Silence &) = delete;
      ~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

    private:
      H5E_auto2_t print_ = nullptr;
      void *data_ = nullptr;
    };

    void write(hid_t file, const char *name, hid_t type, const void *values, std::size_t n)
    {
      const hsize_t size = n;
      const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
      const Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose, name);
      if (n > 0)
        require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
    }

    /// @param most_bytes  no dataset is larger than its file
    template <typename Values>
    Values read(hid_t file, const char *name, hid_t type, std::uintmax_t most_bytes)
    {
      const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, name);
      const Handle stored(H5Dget_type(set), H5Tclose, name),
          space(H5Dget_space(set), H5Sclose, name);
      const hssize_t n = require(H5Sget_simple_extent_npoints(space), name);
      if (H5Tequal(stored, type) <= 0 ||
          static_cast<std::uintmax_t>(n) > most_bytes / sizeof(typename Values::value_type))
        throw Failure(name);
      Values values(static_cast<std::size_t>(n), typename Values::value_type());
      if (n > 0)
        require(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
      return values;
    }

    void write_whole(const std::string &file, const Checkpoint &checkpoint)
    {
      Handle out(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                 "the file");
      const State &state = checkpoint.state;
      write(out, "subject", H5T_NATIVE_CHAR, checkpoint.subject.data(), checkpoint.subject.size());
      write(out, "t", H5T_NATIVE_DOUBLE, &state.t, 1);
      write(out, "u", H5T_NATIVE_DOUBLE, state.u.data(), state.u.size());
      write(out, "v", H5T_NATIVE_DOUBLE, state.v.data(), state.v.size());
      write(out, "records", H5T_NATIVE_DOUBLE, checkpoint.records.data(),
            checkpoint.records.size());
      require(H5Fflush(out, H5F_SCOPE_GLOBAL), "the file");
      out.close("the file");
    }
  } // namespace

  void write_checkpoint(const std::string &file, const Checkpoint &checkpoint)
  {
    const Silence silence;
    const std::string part = file + ".part";
    std::error_code code;
    try
    {
      write_whole(part, checkpoint);
      fs::rename(part, file, code);
      if (!code)
        return;
    }
    catch (const Failure &)
    {
    }
    fs::remove(part, code);
    throw InputError("checkpoint '" + file +
                     "' cannot be written; free some space, or give another output folder (-o)");
  }

  std::optional<Checkpoint> read_checkpoint(const std::string &file)
  {
    std::error_code code;
    if (!fs::exists(file, code))
      return {};
    const Silence silence;
    try
    {
      const std::uintmax_t size = fs::file_size(file);
      const Handle in(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "the file");
      Checkpoint checkpoint;
      checkpoint.subject = read<std::string>(in, "subject", H5T_NATIVE_CHAR, size);
      const Vector t = read<Vector>(in, "t", H5T_NATIVE_DOUBLE, size);
      checkpoint.state.u = read<Vector>(in, "u", H5T_NATIVE_DOUBLE, size);
      checkpoint.state.v = read<Vector>(in, "v", H5T_NATIVE_DOUBLE, size);
      checkpoint.records = read<Vector>(in, "records", H5T_NATIVE_DOUBLE, size);
      if (t.size() != 1 || !std::isfinite(t[0]) ||
          checkpoint.state.u.size() != checkpoint.state.v.size())
        throw Failure("t, u and v");
      checkpoint.state.t = t[0];
      return checkpoint;
    }
    catch (const std::exception &failure)
    {
      throw InputError("checkpoint '" + file + "' cannot be read (" + failure.what() +
                       "); remove it to begin anew");
    }
  }
} // namespace plumbline::analysis
