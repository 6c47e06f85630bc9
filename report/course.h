#pragma once

#include "base/diagnostic.h"
#include "base/source.h"
#include "vm/body/body.h"
#include "vm/stimulus.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// A course: what a ball drives through, read from a drawing (docs/courses.md). All places are
// centimetres of the world of the ball, which starts at 0,0 facing +Y.

namespace orb::report {

/// A rectangle along the axes.
struct Box {
  vm::Point low;
  vm::Point high;

  void include(vm::Point place);
};

/// A part of the floor that has a name.
struct Zone {
  /// How overlapping rings fill: SVG's fill-rule.
  enum class Fill : std::uint8_t { NonZero, EvenOdd };
  /// A circle or ellipse: what is within 1 of its middle once it is made round again.
  struct Ellipse {
    vm::Point middle;
    vm::Point to_x; ///< a place's way from the middle, times this, is the x of the unit circle
    vm::Point to_y;
  };

  std::string id;
  std::vector<std::vector<vm::Point>> rings; ///< its outline, each closed; curves in short pieces
  Fill fill = Fill::NonZero;
  std::optional<Ellipse> ellipse; ///< where it is one, and rings only draw it
  Box box;                        ///< around the rings

  bool contains(vm::Point place) const;
  /// The way from `place` to the zone; 0 within.
  double distance_cm(vm::Point place) const;
};

/// Walls and zones around a start, which is 0,0 facing +Y.
struct Course {
  std::string name; ///< of the file, without folders and ending
  std::vector<vm::Wall> walls;
  std::vector<Zone> zones;
  /// Where the start faces in the drawing, whose y is upwards here; of length 1.
  vm::Point ahead{0, 1};

  /// The zone of that id, or null.
  const Zone* zone(std::string_view id) const;
  /// Around everything, the start too.
  Box box() const;
  /// The walls as what happens to a ball at the start of its run.
  std::vector<vm::TimedStimulus> stimuli() const;
};

/// A course and what is said about its drawing. With an error among it the course is good only for
/// a look.
struct CourseReading {
  Course course;
  std::vector<Diagnostic> findings;
};

/// Reads a drawing. Any bytes are read in time and memory bounded by their number.
CourseReading read_course(const Source& drawing);

/// How the files of courses end.
inline constexpr std::string_view course_ending = ".svg";

/// Whether a file of that name is taken for a course.
bool is_course(std::string_view file_name);

} // namespace orb::report
