// Memory that runs out while a text is read, at every allocation in turn: bad_alloc or the right value, never a mistake of the
// text.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string>

#include "materials/library_reader.hpp"
#include "scene/document.hpp"

namespace {
long until_failure = -1;  // allocations that still succeed; negative: all do
}

__attribute__((noinline)) void* operator new(std::size_t size) {
  if (until_failure >= 0 && until_failure-- == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* memory) noexcept { std::free(memory); }
__attribute__((noinline)) void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace undex::scene {
namespace {

TEST(ReadingWithoutMemory, ANumberIsNoTextAndNoMistake) {
  const std::string text =
      "value = 1.2345678901234567e-6\nlist = [0.1, 2e-3]\nname = \"a word that is too long to be kept in place\"\n";
  long failed = 0;
  for (long allocation = 0;; ++allocation) {
    ASSERT_LT(allocation, 100000);
    Node node;
    bool whole = false;
    until_failure = allocation;
    try {
      node = parse_toml(text, "case.toml");
      whole = true;
    } catch (const std::bad_alloc&) {
      ++failed;
    } catch (...) {
      until_failure = -1;
      FAIL() << "allocation " << allocation << ": neither read nor out of memory";
    }
    const bool reached = until_failure < 0;
    until_failure = -1;
    if (whole) {
      ASSERT_TRUE(node.find("value")->is_number()) << allocation;
      EXPECT_EQ(node.find("value")->number, 1.2345678901234567e-6);
      EXPECT_EQ(node.find("list")->items.size(), 2u);
    }
    if (!reached) break;
  }
  EXPECT_GT(failed, 10);
}

TEST(ReadingWithoutMemory, TheLibraryIsWholeOrNotThere) {
  const std::vector<std::string_view> texts{
      "kind = \"gas\"\n[[set]]\nname = \"a name that is too long to be kept in place\"\nsource = \"\"\ngrade = \"A\"\n"
      "checked = \"\"\nvalid = [0, 1.5e9]\nlaw = \"ideal_gas\"\nrho0 = 1.2345678901234567\ngamma = 1.4\n"};
  long failed = 0;
  for (long allocation = 0;; ++allocation) {
    ASSERT_LT(allocation, 100000);
    materials::Sets sets;
    bool whole = false;
    until_failure = allocation;
    try {
      sets = materials::read_sets(texts);
      whole = true;
    } catch (const std::bad_alloc&) {
      ++failed;
    } catch (const std::exception& other) {
      until_failure = -1;
      FAIL() << "allocation " << allocation << ": " << other.what();
    }
    const bool reached = until_failure < 0;
    until_failure = -1;
    if (whole) {
      ASSERT_EQ(sets.fluids.size(), 1u);
      EXPECT_EQ(sets.fluids[0].rho0, 1.2345678901234567);
    }
    if (!reached) break;
  }
  EXPECT_GT(failed, 10);
}

}  // namespace
}  // namespace undex::scene
