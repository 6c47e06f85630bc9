#include "compiler/text/grammar.h"

#include <gtest/gtest.h>
#include <tao/pegtl/contrib/analyze.hpp>

// PEGTL's own check of a grammar: no rule can loop without consuming.
TEST(Grammar, EveryLoopConsumes) {
  EXPECT_EQ(tao::pegtl::analyze<orb::compiler::grammar::line_rest>(), 0U);
}
