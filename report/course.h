#pragma once

#include "base/diagnostic.h"
#include "base/source.h"
#include "vm/body/body.h"
#include "vm/stimulus.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// A course: the walls and zones that a ball drives through, read from a drawing
// (docs/using/courses.md). All places are centimetres in the world of the ball, which starts at 0,0
// facing +Y.

namespace orb::report {

/// An axis-aligned rectangle.
struct Box {
  vm::Point low;
  vm::Point high;

  void include(vm::Point place);
};

/// A named part of the floor.
struct Zone {
  /// How overlapping rings fill: SVG's fill-rule.
  enum class Fill : std::uint8_t { NonZero, EvenOdd };
  /// A circle or ellipse, as a map to the unit circle.
  struct Ellipse {
    vm::Point middle;
    vm::Point to_x; ///< dot product with the offset from the middle: x on the unit circle
    vm::Point to_y;
  };

  std::string id;
  std::vector<std::vector<vm::Point>> rings; ///< closed outlines; curves as segments
  Fill fill = Fill::NonZero;
  std::optional<Ellipse> ellipse; ///< if it is one; the rings then only draw it
  Box box;                        ///< bounding box of the rings

  bool contains(vm::Point place) const;
  /// Distance from `place` to the zone; 0 inside.
  double distance_cm(vm::Point place) const;
};

/// Walls and zones around a start at 0,0 facing +Y.
struct Course {
  std::string name; ///< of the file, without folders and extension
  std::vector<vm::Wall> walls;
  std::vector<Zone> zones;
  /// The direction of the start in the drawing, with y upwards; a unit vector.
  vm::Point ahead{0, 1};

  /// Returns the zone of that id, or null.
  const Zone* zone(std::string_view id) const;
  /// Bounding box of everything, including the start.
  Box box() const;
  /// Returns the walls as stimuli for the start of a run.
  std::vector<vm::TimedStimulus> stimuli() const;
};

/// A course and the findings about its drawing. With an error among them the course is for
/// inspection only.
struct CourseReading {
  Course course;
  std::vector<Diagnostic> findings;
};

/// Reads a drawing. Time and memory are bounded by its size, whatever its bytes.
CourseReading read_course(const Source& drawing);

/// Extension of course files.
inline constexpr std::string_view course_ending = ".svg";

/// Returns true if a file of that name counts as a course.
bool is_course(std::string_view file_name);

} // namespace orb::report
