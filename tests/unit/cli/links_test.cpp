// Playground addresses as they arrive by mail: complete, truncated, and malicious.

#include "cli/input/links.h"

#include <gtest/gtest.h>
#include <string>
#include <string_view>
#define ZLIB_CONST
#include <zlib.h>

namespace orb::cli {
namespace {

/// Returns an address that holds `text`, encoded as by the page.
std::string address(std::string_view text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL,
               Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  const std::string copy(text);
  stream.next_in = reinterpret_cast<const Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  static constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string link = "https://orb.example/#p=";
  unsigned bits = 0;
  int held = 0;
  for (const char c : packed)
    for (bits = bits << 8 | static_cast<unsigned char>(c), held += 8; held >= 6; held -= 6)
      link += alphabet[bits >> (held - 6) & 63];
  if (held > 0)
    link += alphabet[bits << (6 - held) & 63];
  return link;
}

/// True if the only address in `text` cannot be read and yields no files.
bool is_refused(const std::string& text) {
  const auto found = read_links(text);
  return found && found->size() == 1 && !found->front().trouble.empty() &&
         found->front().files.empty();
}

TEST(Links, HoldFilesAndANameThatIsFitForAPath) {
  const auto found = read_links(address(
      R"({"files":{"a.orb":"print \"grüße\"","../b.orb":"","c.svg":3},"main":"a.orb","name":"A/B\u001b[31m"})"));
  ASSERT_TRUE(found) << found.error();
  ASSERT_EQ(found->size(), 1U);
  const auto& one = found->front();
  EXPECT_EQ(one.files.size(), 1U);
  EXPECT_EQ(one.files.at("a.orb"), "print \"grüße\"");
  EXPECT_EQ(one.main, "a.orb");
  EXPECT_EQ(one.name.find('/'), std::string::npos);
  EXPECT_EQ(one.name.find('\x1b'), std::string::npos);
}

TEST(Links, AreCalledByTheWordsBeforeThemAndNeverTwiceTheSame) {
  const auto link = address(R"({"files":{"a.orb":"print 1"}})");
  const auto found = read_links("\xEF\xBB\xBFname,address\r\nAnna B.: <" + link +
                                ">\r\nAnna B.: " + link + "\n" + link + "\n../..\t" + link + "\n");
  ASSERT_TRUE(found) << found.error();
  ASSERT_EQ(found->size(), 4U);
  EXPECT_EQ((*found)[0].name, "Anna B.");
  EXPECT_EQ((*found)[1].name, "Anna B. 2");
  EXPECT_EQ((*found)[2].name, "3");
  EXPECT_EQ((*found)[3].name, "..-..");
}

TEST(Links, ThatAreCutAreRefusedWhereverTheyEnd) {
  const auto link =
      address(R"({"files":{"a.orb":"print \"hello\"\nRGB red\n","a.test":"test \"t\"\n"}})");
  const auto begin = link.find("#p=") + 3;
  for (auto size = begin; size + 1 < link.size(); ++size)
    EXPECT_TRUE(is_refused(link.substr(0, size))) << size;
  EXPECT_FALSE(is_refused(link));
}

TEST(Links, WithAnyOtherByteAreReadOrRefused) {
  const auto link = address(R"({"files":{"a.orb":"print \"hello\"\nRGB red\n"},"name":"x"})");
  for (auto at = link.find("#p=") + 3; at < link.size(); ++at)
    for (const char c : std::string_view("A_z-")) {
      auto other = link;
      other[at] = c;
      const auto found = read_links(other);
      ASSERT_TRUE(found) << found.error();
      EXPECT_NE(found->front().files.empty(), found->front().trouble.empty());
    }
}

TEST(Links, ThatUnpackToMoreThanAPageTakesAreRefused) {
  const auto bomb = R"({"files":{"a.orb":"print 1"},"x":")" + std::string(4'000'000, 'x') + "\"}";
  const auto found = read_links(address(bomb));
  ASSERT_TRUE(found) << found.error();
  EXPECT_EQ(found->front().trouble, "holds more than 1024 KiB");
}

TEST(Links, OfSomethingElseAreRefused) {
  for (const auto* text : {"", "hello", "https://orb.example/#lesson=x"})
    EXPECT_FALSE(read_links(text)) << text;
  EXPECT_TRUE(is_refused("https://orb.example/#p="));
  for (const auto* json : {"[]", "3", "{}", R"({"files":[]})", R"({"files":{}})", "\xff"})
    EXPECT_TRUE(is_refused(address(json))) << json;
}

TEST(Links, ThatAreDamagedLeaveTheOthersOfTheirListAlone) {
  const auto link = address(R"({"files":{"a.orb":"print 1"}})");
  const auto found = read_links("Anna " + link + "\nBen " + link.substr(0, link.size() - 4) +
                                "\nCem " + link + "\n");
  ASSERT_TRUE(found) << found.error();
  ASSERT_EQ(found->size(), 3U);
  EXPECT_EQ((*found)[1].name, "Ben");
  EXPECT_TRUE((*found)[1].trouble.starts_with("is damaged")) << (*found)[1].trouble;
  EXPECT_TRUE((*found)[2].trouble.empty());
  EXPECT_EQ((*found)[2].files.at("a.orb"), "print 1");
}

TEST(Links, OfTheSameNameAsAnotherWithItsNumberAreTold) {
  const auto link = address(R"({"files":{"a.orb":"print 1"}})");
  const auto found = read_links("Anna 3 " + link + "\nAnna " + link + "\nAnna " + link + "\n");
  ASSERT_TRUE(found) << found.error();
  EXPECT_EQ((*found)[2].name, "Anna 3 3");
}

} // namespace
} // namespace orb::cli
