#include "assembler/text/grammar.h"

#include <gtest/gtest.h>
#include <tao/pegtl/contrib/analyze.hpp>

namespace {

TEST(MacroGrammar, HasNoLoopWithoutProgress) {
  EXPECT_EQ(tao::pegtl::analyze<orb::assembler::grammar::line>(), 0U);
}

} // namespace
