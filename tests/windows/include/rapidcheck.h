// The part of RapidCheck that the tests use, for systems for which Debian does not build it: checks
// the same number of random cases, the same in each run. A failing case is shown as it is, not
// shrunk.

#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rc {

/// The case being generated.
struct Case {
  std::mt19937_64 random{1};
  std::size_t size = 0; ///< the greatest length of containers
  std::ostringstream log;
};
inline Case current;

/// Draws values.
template <typename T>
class Gen {
public:
  template <typename Draw>
  explicit Gen(Draw draw) : draw_(std::move(draw)) {}
  T operator*() const { return draw_(); }

private:
  std::function<T()> draw_;
};

namespace gen {

/// Draws from `from` up to, but not including, `to`.
template <typename T>
Gen<T> inRange(T from, T to) {
  return Gen<T>([=] {
    const auto count = static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
    return static_cast<T>(static_cast<std::uint64_t>(from) +
                          (count == 0 ? 0 : current.random() % count));
  });
}

template <typename Container, typename T>
Gen<Container> container(const Gen<T>& element) {
  return Gen<Container>([=] {
    Container all;
    for (auto left = current.random() % (current.size + 1); left > 0; --left)
      all.push_back(*element);
    return all;
  });
}

template <typename T>
Gen<T> arbitrary() {
  if constexpr (std::is_integral_v<T>)
    return Gen<T>([] { return static_cast<T>(current.random()); });
  else if constexpr (requires { typename T::first_type; })
    return Gen<T>([first = arbitrary<typename T::first_type>(),
                   second = arbitrary<typename T::second_type>()] { return T{*first, *second}; });
  else
    return container<T>(arbitrary<typename T::value_type>());
}

template <typename Container>
Gen<typename Container::value_type> elementOf(const Container& all) {
  return Gen<typename Container::value_type>(
      [=] { return *std::next(all.begin(), *inRange<std::ptrdiff_t>(0, std::size(all))); });
}

template <typename T, typename... Others>
Gen<T> element(const T& first, const Others&... others) {
  return elementOf(std::vector<T>{first, T(others)...});
}

template <typename T, typename... Others>
Gen<T> oneOf(const Gen<T>& first, const Others&... others) {
  return Gen<T>([all = std::vector<Gen<T>>{first, others...}] { return **elementOf(all); });
}

template <typename T, typename Change>
auto map(const Gen<T>& from, Change change) {
  return Gen<std::invoke_result_t<Change, T>>([=] { return change(*from); });
}

template <typename T>
Gen<T> resize(std::size_t size, const Gen<T>& what) {
  return Gen<T>([=] {
    const auto before = std::exchange(current.size, size);
    auto drawn = *what;
    current.size = before;
    return drawn;
  });
}

} // namespace gen

/// Thrown by RC_ASSERT.
struct Falsified {
  const char* condition;
  int line;
};

template <typename... Values>
void check(void (*property)(Values...)) {
  constexpr std::size_t cases = 100;
  current = Case();
  for (; current.size < cases; ++current.size) {
    current.log.str({});
    try {
      property(*gen::arbitrary<std::decay_t<Values>>()...);
    } catch (const Falsified& seen) {
      ADD_FAILURE() << "case " << current.size << ", line " << seen.line << ": " << seen.condition
                    << '\n'
                    << current.log.str();
    }
    if (::testing::Test::HasFailure())
      return;
  }
}

} // namespace rc

#define RC_ASSERT(condition)                                                                       \
  do {                                                                                             \
    if (!(condition))                                                                              \
      throw rc::Falsified{#condition, __LINE__};                                                   \
  } while (false)
#define RC_CLASSIFY(condition, ...) static_cast<void>(condition)
#define RC_LOG() rc::current.log
#define RC_GTEST_PROP(Suite, Name, PARAMETERS)                                                     \
  static void Suite##Name##Property PARAMETERS;                                                    \
  TEST(Suite, Name) {                                                                              \
    rc::check(Suite##Name##Property);                                                              \
  }                                                                                                \
  static void Suite##Name##Property PARAMETERS
