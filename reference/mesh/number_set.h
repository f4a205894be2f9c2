#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace plumbline::reference
{
  /// Numbers below a bound, by one bit each: put in in any order, and taken out in theirs.
  class NumberSet
  {
  public:
    explicit NumberSet(std::size_t bound) : words_((bound + 63) / 64), first_(words_.size()) {}

    void insert(unsigned int number)
    {
      const std::size_t word = number / 64;
      words_[word] |= std::uint64_t(1) << number % 64;
      first_ = std::min(first_, word);
      end_ = std::max(end_, word + 1);
    }

    /// Overwrites `numbers`, ascending. The set is empty then.
    void take(std::vector<unsigned int> &numbers)
    {
      numbers.clear();
      for (; first_ < end_; ++first_)
        for (std::uint64_t &word = words_[first_]; word != 0; word &= word - 1)
          numbers.push_back(static_cast<unsigned int>(64 * first_ + __builtin_ctzll(word)));
      first_ = words_.size();
      end_ = 0;
    }

  private:
    std::vector<std::uint64_t> words_;
    std::size_t first_, end_ = 0; ///< words outside of them are 0
  };
} // namespace plumbline::reference
