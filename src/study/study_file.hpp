// What a user asks of a study: a study file, the key `study` of a case, or the command line.
#pragma once

#include <string>

#include "base/schema.hpp"
#include "input/case.hpp"
#include "plan/effect.hpp"
#include "study/study.hpp"

namespace gannet {

/// The keys of `study`.
Schema study_schema();

/// Puts the keys of `study` into the case language; does nothing in a run.
Effect study_effect();

/// True where the file is a study file: its `study` names a `case`. Other files are cases, which
/// may have a `study` too. False where it cannot be read.
bool is_study_file(const std::string& file);

/// The `study` of a study file or of a case. The case file is that which `study.case` names,
/// otherwise the file itself. Notes mistakes in the case.
StudySpec study_of(Case& read);

/// "peak:slam_force:z,from=1 ms,until=9 ms,percent=99,shift=1 ms,scale=1 m", column and options as
/// needed. Throws std::invalid_argument that says what is wanted.
StudyMeasure parse_measure(const std::string& text);

/// "finest", "richardson", a number with its unit, or a CSV file. Throws std::invalid_argument.
StudyReference parse_reference(const std::string& text);

}  // namespace gannet
