#include "report/journey.h"
#include "report/page.h"
#include "report/svg.h"
#include "report/trace.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace orb::report {
namespace {

namespace event = vm::event;
using Entry = Series<int>::Entry;

constexpr Duration ms(std::int64_t count) {
  return std::chrono::milliseconds{count};
}

TEST(Series, KeepsEverythingUntilItIsFull) {
  Series<int> series(10);
  for (int i = 0; i < 9; ++i)
    series.push(ms(i), i);
  ASSERT_EQ(series.entries().size(), 9U);
  EXPECT_EQ(series.quantum(), Duration{});
  EXPECT_EQ(series.entries()[4].value, 4);
}

TEST(Series, StaysBoundedAndKeepsItsEnds) {
  Series<int> series(100);
  for (int i = 0; i < 100'000; ++i) {
    series.push(ms(i), i);
    ASSERT_LE(series.entries().size(), 100U);
    ASSERT_EQ(series.entries().back().value, i);
  }
  EXPECT_EQ(series.entries().front().value, 0);
  EXPECT_GT(series.entries().size(), 20U);
  for (std::size_t i = 1; i + 1 < series.entries().size(); ++i)
    EXPECT_GE(series.entries()[i].t - series.entries()[i - 1].t, series.quantum());
}

Journey square() {
  Journey journey;
  const int file = journey.add_file("square.bas", "10 goroll 0,90,1\n20 print \"</script>\"\n");
  journey.map_line(10, {file, 1});
  journey.map_line(20, {file, 2});
  journey.add(ms(0), event::Led{{255, 0, 0}});
  journey.add(ms(1), event::Line{10});
  journey.add(ms(50), event::Position{{0, 10, 0, 20}});
  journey.add(ms(100), event::Led{{0, 0, 255}});
  journey.add(ms(100), event::Position{{30, 10, 90, 25}});
  journey.add(ms(120), event::Print{"</script>\n"});
  journey.add(ms(120), event::Line{20});
  journey.add(ms(150), event::Position{{30, -30, 180, 10}});
  journey.add(ms(150), event::Collision{1, 2, 3, 4, 5, 6});
  journey.add(ms(160), event::End{event::End::Reason::End, 2});
  journey.finish(ms(160), "end", "ended");
  return journey;
}

/// A journey with a picture at 70 ms.
Journey pictured(spec::Robot robot) {
  auto journey = square();
  journey.set_robot(robot);
  event::Matrix picture;
  picture.pixels[1] = {1, 0xAB, 255};
  journey.add(ms(70), picture);
  return journey;
}

TEST(Journey, KeepsThePicturesOfAMatrix) {
  const auto journey = pictured(spec::Robot::Bolt);
  ASSERT_EQ(journey.pictures().entries().size(), 1U);
  EXPECT_EQ(journey.pictures().entries()[0].t, ms(70));
  const auto run = run_json(journey, "square.bas");
  EXPECT_NE(run.find("\"matrix\":{\"t\":[70000],\"pixels\":[\"00000001ABFF000000"),
            std::string::npos);
  Shown shown;
  EXPECT_NE(growth_json(journey, shown).find("\"pixels\":[\"00000001ABFF"), std::string::npos);
  EXPECT_EQ(growth_json(journey, shown).find("pixels"), std::string::npos); // already reported
}

TEST(Journey, HasAMatrixOnlyWhereTheRobotHasOne) {
  EXPECT_EQ(run_json(pictured(spec::Robot::Mini), "square.bas").find("pixels"), std::string::npos);
  auto bolt = square();
  EXPECT_EQ(run_json(bolt, "square.bas").find("pixels"), std::string::npos);
  bolt.set_robot(spec::Robot::Bolt);
  EXPECT_NE(run_json(bolt, "square.bas").find("\"matrix\":{\"t\":[],\"pixels\":[]}"),
            std::string::npos);
}

TEST(Trace, HasThePictureOfAMatrix) {
  event::Matrix picture;
  picture.pixels[0] = {255, 0, 1};
  const auto json = trace_line(TraceFormat::Json, ms(5), picture);
  EXPECT_TRUE(json.starts_with("{\"t\":5.000,\"event\":\"matrix\",\"pixels\":\"FF0001000000"))
      << json;
  EXPECT_TRUE(json.ends_with("000000\"}\n")) << json;
  EXPECT_EQ(json.find_last_of('"') - json.find("FF0001"), 64 * 6U);
  // No separate column: all traces have the same columns.
  const auto csv = trace_line(TraceFormat::Csv, ms(5), picture);
  const auto head = trace_head(TraceFormat::Csv);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), std::count(head.begin(), head.end(), ','));
  EXPECT_NE(csv.find(",\"FF0001000000"), std::string::npos);
}

TEST(Journey, AddsUp) {
  const auto journey = square();
  EXPECT_EQ(journey.totals().lines, 2U);
  EXPECT_DOUBLE_EQ(journey.totals().distance_cm, 70);
  EXPECT_DOUBLE_EQ(journey.totals().top_speed_cm_s, 25);
  EXPECT_EQ(journey.counts().at({0, 1}).times, 1U);
  EXPECT_EQ(journey.counts().at({0, 2}).first, ms(120));
  EXPECT_FALSE(journey.thinned());
}

TEST(Journey, ListsTheFirstAndTheLastOfManyEvents) {
  Journey journey;
  for (int i = 0; i < 5000; ++i)
    journey.add(ms(i), event::Print{std::to_string(i) + "\n"});
  const auto listed = journey.listed();
  ASSERT_EQ(listed.happenings.size(), 2000U);
  EXPECT_EQ(listed.left_out, 3000U);
  EXPECT_EQ(listed.happenings[listed.gap_at].text, "4000\n");
  EXPECT_EQ(listed.happenings.back().text, "4999\n");
}

TEST(Journey, CutsLongPrints) {
  Journey journey;
  journey.add(ms(0), event::Print{std::string(100'000, 'x')});
  journey.finish(ms(1), "end", "");
  EXPECT_EQ(journey.listed().happenings.front().text.size(), 200U);
}

TEST(Journey, JoinsPrintsToTheLinesThatTheRobotSends) {
  Journey journey;
  journey.add(ms(1), event::Print{"a"});
  journey.add(ms(2), event::Print{"b\nc\nd"});
  journey.finish(ms(3), "end", "");
  const auto lines = journey.listed().happenings;
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].text, "ab\n");
  EXPECT_EQ(lines[0].t, ms(2));
  EXPECT_EQ(lines[2].text, "d");
  EXPECT_EQ(lines[2].t, ms(3));
}

TEST(Report, NoTextOfAProgramEndsItsScript) {
  const auto page = report_page(square(), "</script><!--");
  std::size_t ends = 0;
  for (auto at = page.find("</script>"); at != std::string::npos;
       at = page.find("</script>", at + 1))
    ++ends;
  EXPECT_EQ(ends, 3U); // of the data, the earlier run and the script
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  EXPECT_EQ(page.find("/*{"), std::string::npos) << "a place was not filled";
}

TEST(Report, ARunComesBackOutOfItsPage) {
  const auto page = report_page(square(), "</script><!--");
  const auto run = run_of_page(page);
  ASSERT_TRUE(run);
  EXPECT_NE(page.find(*run), std::string::npos);
  const auto both = report_page(square(), "after", *run);
  EXPECT_NE(both.find(*run), std::string::npos);
  EXPECT_NE(*run_of_page(both), *run);
  EXPECT_FALSE(run_of_page("<html>"));
  EXPECT_FALSE(run_of_page(R"(<script type="application/json" id="run">[1]</script>)"));
}

TEST(Report, BytesThatAreNotTextSurvive) {
  Journey journey;
  journey.add_file("\xFF.bas", "10 print \"\xFE\"\n");
  journey.add(ms(0), event::Print{"\xE4\x00\x1B"});
  journey.finish(ms(1), "end", "");
  EXPECT_NE(report_page(journey, "\xFF").find("\\u00e4"), std::string::npos);
}

TEST(Svg, DrawsEachStretchInTheColourOfItsMoment) {
  const auto svg = path_svg(square());
  EXPECT_NE(svg.find("stroke=\"#ff0000\""), std::string::npos);
  EXPECT_NE(svg.find("stroke=\"#0000ff\""), std::string::npos);
  EXPECT_NE(svg.find("class=\"hit\""), std::string::npos);
  EXPECT_EQ(svg, path_svg(square()));
}

TEST(Svg, DrawsARingForABallThatStayed) {
  Journey journey;
  journey.add(ms(0), event::Led{{255, 0, 0}});
  journey.add(ms(500), event::Led{{0, 255, 0}});
  journey.finish(ms(1000), "end", "");
  const auto svg = path_svg(journey);
  EXPECT_NE(svg.find("class=\"arc\" stroke=\"#00ff00\""), std::string::npos);
  EXPECT_EQ(svg.find("class=\"path\""), std::string::npos);
}

TEST(Svg, AnEmptyRunIsAPictureToo) {
  EXPECT_NE(path_svg(Journey{}).find("</svg>"), std::string::npos);
}

} // namespace
} // namespace orb::report
