#pragma once

#include <fftw3.h>

#include <cstddef>
#include <utility>

namespace plumbline::base
{
  /// An FFTW plan that is destroyed with its owner.
  class Plan
  {
  public:
    Plan() = default;
    explicit Plan(fftw_plan plan) : plan_(plan) {}
    Plan(Plan &&other) noexcept : plan_(std::exchange(other.plan_, nullptr)) {}
    Plan &operator=(Plan &&other) noexcept
    {
      std::swap(plan_, other.plan_);
      return *this;
    }
    ~Plan()
    {
      if (plan_ != nullptr)
        fftw_destroy_plan(plan_);
    }
    fftw_plan get() const { return plan_; }

  private:
    fftw_plan plan_ = nullptr;
  };

  /// Memory aligned for FFTW's vector instructions.
  template <class T>
  class AlignedArray
  {
  public:
    AlignedArray() = default;
    explicit AlignedArray(std::size_t size)
        : data_(static_cast<T *>(fftw_malloc(sizeof(T) * size))), size_(size)
    {
    }
    AlignedArray(AlignedArray &&other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0))
    {
    }
    AlignedArray &operator=(AlignedArray &&other) noexcept
    {
      std::swap(data_, other.data_);
      std::swap(size_, other.size_);
      return *this;
    }
    ~AlignedArray() { fftw_free(data_); }
    T *data() const { return data_; }
    std::size_t size() const { return size_; }
    T &operator[](std::size_t i) const { return data_[i]; }

  private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
  };

  /// The smallest 2^a 3^b 5^c 7^d >= n with d <= 1: a length that FFTW transforms fast.
  int fast_length(int n);

  /// Let the plans that follow use the threads that deal.II may use, if the transform is large: one
  /// thread for 0 points.
  void set_plan_threads(std::size_t n_points);
} // namespace plumbline::base
