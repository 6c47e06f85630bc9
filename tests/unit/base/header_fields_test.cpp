#include "base/text/header_fields.h"

#include <gtest/gtest.h>
#include <initializer_list>
#include <rapidcheck/gtest.h>
#include <string>

namespace orb {
namespace {

using Found = BodyLength::Found;

TEST(BodyLength, IsReadFromItsLine) {
  for (const auto* header : {"Content-Length: 12", "Content-Type: x\r\ncontent-length:12\r\nX: y",
                             "CONTENT-LENGTH :\t12 ", "a: b\nContent-Length: 12\n",
                             "Content-Length: 12\r\nContent-Length: 12"}) {
    const auto length = body_length(header);
    EXPECT_EQ(length.said, Found::Length) << header;
    EXPECT_EQ(length.bytes, 12U) << header;
  }
}

TEST(BodyLength, IsNothingWithoutALine) {
  for (const auto* header :
       {"", "\r\n", ":", "Content-Type: 12", "Content-Length 12", "x: y\r\n\r\n"})
    EXPECT_EQ(body_length(header).said, Found::Nothing) << header;
}

TEST(BodyLength, IsNonsenseWhereItIsNoNumber) {
  for (const auto* header :
       {"Content-Length:", "Content-Length: ", "Content-Length:\t\r\nX: y", "Content-Length: -1",
        "Content-Length: +1", "Content-Length: 2x", "Content-Length: 99999999999999999999",
        "Content-Length: 1\r\nContent-Length: 2"})
    EXPECT_EQ(body_length(header).said, Found::Nonsense) << header;
}

RC_GTEST_PROP(BodyLength, SaysSomethingOfAnyBytes, (std::string before, std::string value)) {
  const auto length = body_length(before + "\nContent-Length:" + value);
  RC_ASSERT(length.said != Found::Nothing);
  RC_ASSERT(length.said == Found::Length || length.bytes == 0U);
}

} // namespace
} // namespace orb
