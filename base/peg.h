#pragma once

#include <tao/pegtl.hpp>

// The common base of the three parsers (compiler/, assembler/, structured/): PEGTL rules matched by
// hand, their actions, and the error if a required rule does not match. Each parser defines in its
// own namespace a Builder, a ParseStop that ends the parse of a line, and `template <typename Rule>
// constexpr … reason`, the reason passed to ParseStop. Only parsers include this header: it takes a
// second to compile.

/// The template header of a match function that calls other rules.
#define ORB_RULE_TEMPLATE                                                                          \
  template <apply_mode A, rewind_mode M, template <typename...> class Action,                      \
            template <typename...> class Control, typename Input>

/// A rule matched by hand, with its body in ORB_MATCH(name). The `analyze_traits` declare what it
/// consumes, so that analyze() can prove that no loop runs without progress.
#define ORB_BY_HAND(name)                                                                          \
  struct name {                                                                                    \
    using rule_t = name;                                                                           \
    using subs_t = empty_list;                                                                     \
    ORB_RULE_TEMPLATE static bool match(Input& in, Builder& builder);                              \
  };
#define ORB_MATCH(name)                                                                            \
  ORB_RULE_TEMPLATE bool name::match([[maybe_unused]] Input& in, [[maybe_unused]] Builder& builder)
/// Matches another rule, within ORB_MATCH; true if it matches.
#define ORB_MATCHES(rule) Control<rule>::template match<A, M, Action, Control>(in, builder)

/// Sets the reason reported if a required rule does not match. The rule may contain commas.
#define ORB_REASON(what, ...)                                                                      \
  template <>                                                                                      \
  inline constexpr auto reason<__VA_ARGS__> = what;

/// Throws a ParseStop for the rule that should have matched.
#define ORB_CONTROL                                                                                \
  template <typename Rule>                                                                         \
  struct Control : tao::pegtl::normal<Rule> {                                                      \
    template <typename Input>                                                                      \
    [[noreturn]] static void raise(const Input& in, Builder&) {                                    \
      throw ParseStop{reason<Rule>, in.current()};                                                 \
    }                                                                                              \
  };

/// Defines the action for a matched `rule`; `in` is the text it consumed.
#define ORB_ACTIONS                                                                                \
  template <typename Rule>                                                                         \
  struct Action : tao::pegtl::nothing<Rule> {};
#define ORB_ACTION(rule, body)                                                                     \
  template <>                                                                                      \
  struct Action<rule> {                                                                            \
    template <typename Input>                                                                      \
    static void apply([[maybe_unused]] const Input& in, Builder& builder) {                        \
      body;                                                                                        \
    }                                                                                              \
  };

namespace orb::peg {

/// Input without line tracking: each text is one line.
using Input =
    tao::pegtl::memory_input<tao::pegtl::tracking_mode::lazy, tao::pegtl::eol::lf, const char*>;

} // namespace orb::peg
