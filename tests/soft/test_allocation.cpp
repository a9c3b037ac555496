#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>
#include <sstream>

#include "small_chute.hpp"

// Every allocation of this executable is counted here.
namespace {
std::size_t allocations = 0;
void* counted(std::size_t size, std::size_t align) {
  ++allocations;
  void* p = std::aligned_alloc(align, (size + align - 1) / align * align);
  if (!p) throw std::bad_alloc();
  return p;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t align) {
  return counted(size, static_cast<std::size_t>(align));
}
void* operator new[](std::size_t size, std::align_val_t align) {
  return counted(size, static_cast<std::size_t>(align));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size, alignof(std::max_align_t));
}
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete[](void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace chute;
using namespace chute::test;

TEST_CASE("allocations are counted") {
  const auto before = allocations;
  const std::vector<double> numbers(10);
  const Array aligned(10);
  CHECK(allocations == before + 2);
}

namespace {

/// Arrays grow when there are more pairs than ever before. To have seen it all, the engine first runs the
/// very way that is then counted.
template <int D>
void check_no_allocation(soft::SoftEngine<D>& engine, std::int64_t warm_up, std::int64_t steps) {
  engine.advance_to(warm_up);
  std::stringstream start;
  engine.save(start);
  engine.advance_to(warm_up + steps);
  engine.restore(start);
  REQUIRE(engine.step() == warm_up);
  const auto near = engine.neighbours().near_builds(), far = engine.neighbours().far_builds();
  const auto before = allocations;
  for (int i = 0; i < 1'000; ++i) engine.advance_to(engine.step() + 1);
  engine.advance_to(warm_up + steps);
  const auto after = allocations;
  CHECK(after == before);
  CHECK(engine.neighbours().near_builds() > near + 1);
  CHECK(engine.neighbours().far_builds() > far + 1);
}

}  // namespace

TEST_CASE("a step allocates nothing, whether or not it makes lists anew") {
  const SmallChute chute;
  for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet}) {
    soft::SoftEngine<2> engine(chute.grains(), chute.setup(50, scheme));
    check_no_allocation(engine, 20'000, 8'000);
  }
}

TEST_CASE("a step in 3D allocates nothing") {
  soft::SoftEngine<3> engine(small_box(), small_box_setup(50));
  check_no_allocation(engine, 4'000, 6'000);
}
