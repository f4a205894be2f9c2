// What the assembly by sides takes at its peak, byte by byte: all that is allocated is counted.
#include "geometry/mesh_input.h"
#include "reference/mesh/assembly.h"

#include <gtest/gtest.h>

#include <deal.II/base/multithread_info.h>

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

namespace
{
  std::atomic<std::size_t> now = 0, most = 0; // bytes

  void *allocate(std::size_t size)
  {
    void *const place = std::malloc(size > 0 ? size : 1);
    if (place == nullptr)
      throw std::bad_alloc();
    const std::size_t sum = now += malloc_usable_size(place);
    std::size_t before = most;
    while (before < sum && !most.compare_exchange_weak(before, sum))
    {
    }
    return place;
  }

  void release(void *place) noexcept
  {
    if (place != nullptr)
      now -= malloc_usable_size(place);
    std::free(place);
  }
} // namespace

// those of arrays and those that do not throw call these
void *operator new(std::size_t size)
{
  return allocate(size);
}
void operator delete(void *place) noexcept
{
  release(place);
}
void operator delete(void *place, std::size_t) noexcept
{
  release(place);
}

namespace
{
  using namespace plumbline;
  using geometry::Point;

  struct Peak
  {
    double bytes_of_entry = 0, bytes_of_result = 0; ///< of an entry
    std::string way;
  };

  Peak measure(const physics::Kernel<2> &kernel, double h, bool exact = true)
  {
    const geometry::Domain square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};
    const auto mesh = std::make_shared<const geometry::Mesh>(
        geometry::lattice_mesh(square, h, kernel.horizon(), true));
    const reference::MeshSpace space(mesh, true, 1);
    const reference::MeshCells cells(*mesh);
    const std::size_t before = now;
    most = before;
    const auto matrix = reference::assemble(
        space, cells, kernel, {}, {0, exact, geometry::Backend::fast}, base::Communicator::alone());
    const auto n_entries = static_cast<double>(matrix.rows.value.size());
    return {static_cast<double>(most - before) / n_entries,
            static_cast<double>(now - before) / n_entries, matrix.way};
  }

  const std::string by_edges = "exact by pairs of sides of the triangles";
} // namespace

TEST(EntryMemory, CountsWhatIsAllocated)
{
  const std::size_t before = now;
  most = before;
  {
    const std::vector<double> some(1000), more(2000);
    EXPECT_GE(now - before, 24000u);
  }
  EXPECT_EQ(now, before);
  EXPECT_GE(most - before, 24000u);
  EXPECT_LT(most - before, 24100u);
}

TEST(EntryMemory, OfAssemblyByEdgesIsTwentyFourBytesAnEntryAtMost)
{
  dealii::MultithreadInfo::set_thread_limit(1); // each has a scratch of its own
  const double h = 1. / 48;
  const auto expect_little =
      [&](const physics::Kernel<2> &kernel, const std::string &title, double allowed)
  {
    const Peak peak = measure(kernel, h);
    EXPECT_EQ(peak.way, by_edges);
    EXPECT_LT(peak.bytes_of_entry, allowed) << title;
    EXPECT_GT(peak.bytes_of_entry, 12) << title; // a number and its column
    EXPECT_LT(peak.bytes_of_result, 15) << title;
    RecordProperty(title, std::to_string(peak.bytes_of_entry));
  };
  using physics::RadialProfile;
  const RadialProfile::Powers linear_decay = {{1, 0}, {-1, 1}};
  const double horizon = 8 * h;
  expect_little(physics::Kernel<2>::with_diffusion(linear_decay, horizon, 1), "scalar", 21);
  expect_little(physics::Kernel<2>::with_bulk_modulus(linear_decay, 6 * h, 1), "tensor", 24);
  for (const auto &[at, title] : {std::pair(.6, "break"), std::pair(.9, "break_at_the_horizon")})
    expect_little(physics::Kernel<2>::with_diffusion(
                      RadialProfile::table({{0, 2}, {at, 1}, {1, .2}}), horizon, 1),
                  title, 24);
  dealii::MultithreadInfo::set_thread_limit();
}
