#include "report/course.h"
#include "report/rules.h"
#include "report/svg_path.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace orb::report {
namespace {

CourseReading read(std::string text) {
  return read_course(Source("halls/hall.svg", std::move(text)));
}

/// Reads a drawing of `inside` and a start at 0,0 that faces up.
Course course(const std::string& inside) {
  auto reading = read("<svg><circle class='start' r='4'/>" + inside + "</svg>");
  for (const auto& one : reading.findings)
    ADD_FAILURE() << inside << ": " << in_english(one.message);
  return std::move(reading.course);
}

std::vector<std::string> walls(const std::string& inside) {
  std::vector<std::string> words;
  for (const auto& wall : course(inside).walls)
    words.push_back(vm::to_string(wall));
  return words;
}

using Words = std::vector<std::string>;

TEST(Course, EveryRuleHasAnExampleThatRaisesItAndOneThatDoesNot) {
  for (const auto& rule : rules::all()) {
    const auto bad = read(std::string(rule.bad));
    ASSERT_EQ(bad.findings.size(), 1U) << rule.id;
    EXPECT_EQ(bad.findings[0].rule->id, rule.id);
    EXPECT_TRUE(read(std::string(rule.good)).findings.empty()) << rule.id;
  }
}

TEST(Course, IsCalledByItsFile) {
  EXPECT_EQ(course("<line class='wall' y1='-9' y2='-20'/>").name, "hall");
  EXPECT_TRUE(is_course("a/B.SVG"));
  EXPECT_FALSE(is_course(".svg"));
}

TEST(Course, ReadsEveryKindOfWall) {
  EXPECT_EQ(walls("<line class='wall' x1='10' y1='-20' x2='30' y2='5'/>"), Words{"10,20 to 30,-5"});
  EXPECT_EQ(walls("<polyline class='wall' points='10,0 20,0 20,10'/>"),
            (Words{"10,0 to 20,0", "20,0 to 20,-10"}));
  EXPECT_EQ(walls("<polygon class='big wall' points='10 0 20 0 20 10'/>"),
            (Words{"10,0 to 20,0", "20,0 to 20,-10", "20,-10 to 10,0"}));
  EXPECT_EQ(walls("<rect class='wall' x='5' y='5' width='2' height='1'/>"),
            (Words{"5,-5 to 7,-5", "7,-5 to 7,-6", "7,-6 to 5,-6", "5,-6 to 5,-5"}));
  EXPECT_EQ(walls("<path inkscape:label='Wall' d='m10-10h5V20l-1.5.5z M40,0 50,0'/>"),
            (Words{"10,10 to 15,10", "15,10 to 15,-20", "15,-20 to 13.5,-20.5",
                   "13.5,-20.5 to 10,10", "40,0 to 50,0"}));
  EXPECT_EQ(walls("<path class='wall' d='M10 0C12 0 18 0 20 0'/>"), Words{"10,0 to 20,0"})
      << "a curve that is straight";
}

TEST(Course, AppliesTransformsFromTheInsideOut) {
  EXPECT_EQ(walls("<g transform='translate(100 0)'><g transform='rotate(90)'>"
                  "<line class='wall' x1='10' x2='20' transform='scale(2,3)'/></g></g>"),
            Words{"100,-20 to 100,-40"});
  EXPECT_EQ(walls("<line class='wall' x2='10' transform='matrix(0 1 -1 0 5 6)'/>"),
            Words{"5,-6 to 5,-16"});
  EXPECT_EQ(walls("<line class='wall' x1='-10' x2='20' transform='rotate(180, 20, 0)'/>"),
            Words{"50,0 to 20,0"});
}

TEST(Course, MeasuresInTheUnitsOfThePage) {
  const auto first = [](const std::string& head) {
    const auto reading = read("<svg " + head +
                              "><circle class='start' r='4'/>"
                              "<line class='wall' y1='-100' x2='50' y2='-100'/></svg>");
    return reading.course.walls.empty() ? "none" : vm::to_string(reading.course.walls[0]);
  };
  EXPECT_EQ(first(""), "0,100 to 50,100");
  EXPECT_EQ(first("width='400' height='300' viewBox='0 0 400 300'"), "0,100 to 50,100");
  EXPECT_EQ(first("width='100%' viewBox='0 0 400 300'"), "0,100 to 50,100");
  EXPECT_EQ(first("width='210mm' height='297mm' viewBox='0 0 210 297'"), "0,10 to 5,10");
  EXPECT_EQ(first("width='10in' viewBox='0 0 10 10'"), "0,254 to 127,254");
  EXPECT_EQ(first("width='960px' height='96px' viewBox='0 0 960 96'"),
            "0,2.64583 to 1.32292,2.64583");
  EXPECT_EQ(first("height='3m' viewBox='0 0 4 3'"), "none") << "m is no unit of SVG";
}

TEST(Course, TheStartIsWhereACircleIsAndFacesUp) {
  const auto wall = [](const std::string& start) {
    const auto reading =
        read("<svg>" + start + "<line class='wall' x1='10' y1='10' x2='30' y2='10'/></svg>");
    return reading.course.walls.empty() ? in_english(reading.findings[0].message)
                                        : vm::to_string(reading.course.walls[0]);
  };
  EXPECT_EQ(wall("<circle class='start' cx='10' cy='30' r='4'/>"), "0,20 to 20,20");
  EXPECT_EQ(wall("<circle class='start' cx='10' cy='30' r='4' data-heading='90'/>"),
            "-20,0 to -20,20");
  EXPECT_EQ(wall("<circle class='start' r='4' transform='translate(10 30) rotate(90)'/>"),
            "-20,0 to -20,20");
  EXPECT_EQ(wall("<line class='start' x1='10' y1='30' x2='15' y2='30'/>"), "-20,0 to -20,20");
  EXPECT_EQ(wall("<path class='start' d='M15 30H10' style='marker-start:url(#a)'/>"),
            "-20,0 to -20,20")
      << "its head is at its first point";
  EXPECT_EQ(wall("<g class='start'><circle cx='10' cy='30' r='4'/><path d='M14 30h3'/></g>"),
            "-20,0 to -20,20")
      << "together they are one start";
  EXPECT_EQ(wall("<circle class='start' r='1'/><circle class='start' r='2'/>"),
            "the course has 2 starts");
  EXPECT_EQ(wall("<rect class='start' width='2' height='2'/>"),
            "this shape gives no direction for the ball");
}

TEST(Course, LeavesOutWhatIsNotDrawn) {
  EXPECT_EQ(walls("<defs><line class='wall' x2='9'/></defs>"
                  "<g style='fill:red; display : none'><line class='wall' x2='9'/></g>"
                  "<g inkscape:label='walls'><line display='none' x2='9'/><text>north</text>"
                  "<line x1='10' x2='20'/></g>"),
            Words{"10,0 to 20,0"});
}

TEST(Zone, HoldsWhatIsInside) {
  const auto inside = [](const std::string& shape, double x, double y) {
    const auto made = course(shape);
    return made.zones.size() == 1 && made.zones[0].contains({x, y});
  };
  const std::string rect = "<rect class='zone' id='a' x='10' y='10' width='20' height='10'/>";
  EXPECT_TRUE(inside(rect, 11, -11));
  EXPECT_FALSE(inside(rect, 9, -11));
  EXPECT_FALSE(inside(rect, 11, 11));
  const std::string round = "<circle class='zone' id='a' cx='10' cy='-10' r='5'/>";
  EXPECT_TRUE(inside(round, 13.5, 13.5));
  EXPECT_FALSE(inside(round, 13.6, 13.6));
  const std::string oval =
      "<ellipse class='zone' id='a' rx='20' ry='5' transform='translate(0,-50) rotate(-45)'/>";
  EXPECT_TRUE(inside(oval, 13, 63));
  EXPECT_FALSE(inside(oval, -13, 63));
  const std::string ring = "<path class='zone' id='a' d='M0 0h30v30h-30z M10 10h10v10h-10z'";
  EXPECT_TRUE(inside(ring + "/>", 15, -15)) << "SVG fills twice wound places";
  EXPECT_FALSE(inside(ring + " fill-rule='evenodd'/>", 15, -15));
  EXPECT_TRUE(inside(ring + " style='fill-rule:evenodd'/>", 5, -5));
  const std::string blob = "<path class='zone' id='a' d='M0 0A10 10 0 0 1 20 0z'/>";
  EXPECT_TRUE(inside(blob, 10, 9.5)) << "an arc over the top";
  EXPECT_FALSE(inside(blob, 10, -1));
  EXPECT_TRUE(inside("<path class='zone' id='a' d='M0 0q10-20 20 0t20 0z'/>", 10, 5));
  EXPECT_TRUE(
      inside("<rect class='zone' id='a' x='10' y='-30' width='20' height='20' rx='5'/>", 11, 20));
  EXPECT_FALSE(
      inside("<rect class='zone' id='a' x='10' y='-30' width='20' height='20' rx='5'/>", 11, 29));
}

TEST(Zone, TellsHowFarItIs) {
  const auto made = course("<rect class='zone' id='a' x='10' y='-20' width='10' height='10'/>");
  ASSERT_NE(made.zone("a"), nullptr);
  EXPECT_EQ(made.zone("b"), nullptr);
  EXPECT_DOUBLE_EQ(made.zone("a")->distance_cm({7, 15}), 3);
  EXPECT_DOUBLE_EQ(made.zone("a")->distance_cm({7, 6}), 5);
  EXPECT_DOUBLE_EQ(made.zone("a")->distance_cm({12, 12}), 0);
}

// A circle does not depend on how it was drawn, and the rings that draw it agree with it.
RC_GTEST_PROP(Zone, TurnsWithTheStart, ()) {
  const int heading = *rc::gen::inRange(0, 360);
  const int x = *rc::gen::inRange(-100, 100);
  const int y = *rc::gen::inRange(-100, 100);
  const auto reading = read(fmt::format("<svg><circle class='start' cx='5' cy='7' r='4' "
                                        "data-heading='{}'/><ellipse class='zone' id='a' cx='{}' "
                                        "cy='{}' rx='9' ry='4' transform='skewX(20)'/></svg>",
                                        heading, x, y));
  RC_ASSERT(reading.findings.empty());
  auto zone = reading.course.zones[0];
  const auto middle = zone.ellipse->middle;
  RC_ASSERT(zone.contains(middle));
  auto drawn = zone;
  drawn.ellipse.reset();
  for (const auto& point : zone.rings[0]) {
    const auto toward = [&](double share) {
      return vm::Point{middle.x + (point.x - middle.x) * share,
                       middle.y + (point.y - middle.y) * share};
    };
    RC_ASSERT(zone.contains(toward(.99)) && drawn.contains(toward(.99)));
    RC_ASSERT(!zone.contains(toward(1.01)) && !drawn.contains(toward(1.01)));
  }
}

TEST(Course, WhatNobodyDrewIsRefusedQuickly) {
  const auto first = [](std::string text) {
    const auto reading = read(std::move(text));
    return reading.findings.empty() ? std::string("nothing")
                                    : std::string(reading.findings[0].rule->id);
  };
  std::string deep, many = "<svg><circle class='start' r='4'/>";
  for (int i = 0; i < 100'000; ++i)
    deep += "<g>";
  EXPECT_EQ(first("<svg>" + deep), "course-xml");
  std::string closed;
  for (int i = 0; i < 100'000; ++i)
    closed += "</g>";
  EXPECT_EQ(first("<svg>" + deep + closed + "</svg>"), "course-too-large");
  for (int i = 0; i < 110'000; ++i)
    many += "<g/>";
  EXPECT_EQ(first(many + "</svg>"), "course-too-large");
  EXPECT_EQ(first(std::string(5 << 20, ' ')), "course-too-large");
  std::string path = "M0 0";
  for (int i = 0; i < 20'000; ++i)
    path += "h1";
  EXPECT_EQ(first("<svg><path class='wall' d='" + path + "'/></svg>"), "course-value");
  EXPECT_EQ(first("<!DOCTYPE svg [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;'>]><svg>&b;</svg>"),
            "course-xml");
  EXPECT_EQ(first(std::string("<svg>\0</svg>", 12)), "course-xml");
  EXPECT_EQ(first("\x1f\x8b\x08"), "course-xml");
  EXPECT_EQ(first(""), "course-xml");
  EXPECT_EQ(first("<svg><line class='wall' x1='nan' x2='1e999'/></svg>"), "course-value");
}

} // namespace
} // namespace orb::report
