// What outlasts a step. Whoever holds such state names each number and array of it once, in a `visit_state`; a visitor saves
// them, gives them their saved values back, or adds up a fingerprint. Nothing else says what a checkpoint holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/timers.hpp"
#include "core/vector.hpp"

namespace undex {

/// What an item of an array is made of: numbers of one kind side by side.
struct ItemType {
  enum class Number { byte, int32, uint32, int64, uint64, float32, float64 };
  Number number = Number::byte;
  std::size_t count = 1;                                                    ///< numbers in an item
  std::size_t bytes = 1;                                                    ///< of an item
  bool comparable() const { return number != Number::byte || bytes == 1; }  ///< false: it may hold bytes without meaning

  bool operator==(const ItemType&) const = default;
};

/// Arithmetic types, enumerations, vectors and matrices by their numbers; other structures of plain data as bytes.
template <class T>
constexpr ItemType item_type() {
  using Number = ItemType::Number;
  if constexpr (std::is_enum_v<T>) return item_type<std::underlying_type_t<T>>();
  else if constexpr (std::is_same_v<T, double>) return {Number::float64, 1, sizeof(T)};
  else if constexpr (std::is_same_v<T, float>) return {Number::float32, 1, sizeof(T)};
  else if constexpr (std::is_integral_v<T> && sizeof(T) == 8)
    return {std::is_signed_v<T> ? Number::int64 : Number::uint64, 1, sizeof(T)};
  else if constexpr (std::is_integral_v<T> && sizeof(T) == 4)
    return {std::is_signed_v<T> ? Number::int32 : Number::uint32, 1, sizeof(T)};
  else if constexpr (std::is_integral_v<T> && sizeof(T) == 1) return {Number::byte, 1, 1};
  else if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, Mat3>) return {Number::float64, sizeof(T) / 8, sizeof(T)};
  else {
    static_assert(std::is_trivially_copyable_v<T>, "an item of state is plain data");
    return {Number::byte, sizeof(T), sizeof(T)};
  }
}

class StateVisitor {
 public:
  virtual ~StateVisitor() = default;

  /// Do the numbers visited receive saved values?
  virtual bool restores() const = 0;
  /// Does it want what a run has cost, which is no state of the simulation?
  virtual bool wants_cost() const { return true; }

  template <class T>
  void operator()(std::string_view name, T& value) {
    visit(path_ + std::string(name), {.type = item_type<T>(), .count = 1, .data = &value, .resize = {}});
  }
  template <class T>
  void operator()(std::string_view name, std::vector<T>& values) {
    const auto resize = [&values](std::size_t count) -> void* {
      values.resize(count);
      return values.data();
    };
    visit(path_ + std::string(name), {.type = item_type<T>(), .count = values.size(), .data = values.data(), .resize = resize});
  }
  void operator()(std::string_view name, std::string& text) {
    const auto resize = [&text](std::size_t count) -> void* {
      text.resize(count);
      return text.data();
    };
    visit(path_ + std::string(name), {.type = item_type<char>(), .count = text.size(), .data = text.data(), .resize = resize});
  }
  /// One array after another, under their numbers. Their count is not state: it is the scene's.
  template <class T>
  void operator()(std::string_view name, std::vector<std::vector<T>>& arrays) {
    part(name, [&] {
      for (std::size_t k = 0; k < arrays.size(); ++k) (*this)(std::to_string(k), arrays[k]);
    });
  }
  void operator()(std::string_view name, PassTimers& timers);

  /// What `visit_members` names belongs to the part of that name.
  template <class VisitMembers>
  void part(std::string_view name, VisitMembers visit_members) {
    const std::string before = path_;
    path_ += std::string(name) + "/";
    visit_members();
    path_ = before;
  }

 protected:
  /// An array of state.
  struct Array {
    ItemType type;
    std::size_t count;  ///< items
    void* data;
    std::function<void*(std::size_t)> resize;  ///< gives it another number of items; empty: it has one
  };
  virtual void visit(const std::string& path, const Array& array) = 0;

 private:
  std::string path_;
};

}  // namespace undex
