// A small case language for the tests of the reader, and help to read texts in it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "input/case.hpp"

namespace gannet::test {

inline Schema materials_keys() {
  return {{"materials.*", {.name = "density", .unit = dim::density, .limits = positive()}},
          {"materials.*", {.name = "young", .unit = dim::pressure, .limits = positive()}},
          {"materials.*",
           {.name = "c0", .unit = dim::velocity, .limits = positive(), .choices = {"auto"}}},
          {"materials.*", {.name = "poisson", .limits = {-1, 0.5, true, true}}}};
}

inline Schema parts_keys() {
  const Key material{.name = "material",
                     .kind = Kind::reference,
                     .text = "what it is made of",
                     .required = true,
                     .refers_to = "materials"};
  Key shell{.name = "shell", .kind = Kind::map};
  shell.keys = {material,
                {.name = "thickness",
                 .unit = dim::length,
                 .text = "of the sheet",
                 .required = true,
                 .limits = positive()},
                {.name = "points", .kind = Kind::integer, .fallback = "5", .limits = between(1, 9)},
                {.name = "formulation",
                 .kind = Kind::choice,
                 .fallback = "belytschko_lin_tsay",
                 .choices = {"belytschko_lin_tsay", "hughes_liu"}}};
  Key sph{.name = "sph", .kind = Kind::map};
  sph.keys = {material, {.name = "spacing", .unit = dim::length, .limits = positive()}};
  return {{"parts.*", shell},
          {"parts.*", sph},
          {"parts.*", {.name = "mesh", .kind = Kind::path}},
          {"parts.*", {.name = "velocity", .kind = Kind::vector, .unit = dim::velocity}}};
}

inline Schema small_language() {
  Schema s = materials_keys();
  for (const SchemaEntry& entry : parts_keys()) s.push_back(entry);
  Key planes{.name = "planes", .kind = Kind::map};
  planes.keys = {{.name = "x", .kind = Kind::numbers, .unit = dim::length}};
  s.push_back({"boundaries.*", planes});
  s.push_back({"boundaries.*", {.name = "velocity", .kind = Kind::any}});
  s.push_back({"boundaries.*", {.name = "fix", .kind = Kind::names, .choices = {"x", "y", "rx"}}});
  s.push_back({"contacts.*", {.name = "between", .kind = Kind::names, .refers_to = "parts"}});
  s.push_back({"loads", {.name = "gravity", .kind = Kind::vector, .unit = dim::acceleration}});
  s.push_back({"loads.*", {.name = "pressure", .unit = dim::pressure}});
  s.push_back({"effects",
               {.name = "xsph",
                .kind = Kind::map,
                .keys = {{.name = "epsilon", .fallback = "0.5", .limits = between(0, 1)},
                         {.name = "on", .kind = Kind::flag, .fallback = "yes"}}}});
  return s;
}

inline std::unique_ptr<Case> read(const std::string& text,
                                  const std::vector<std::string>& overrides = {},
                                  const std::string& file = "tests/a.yaml") {
  return read_case_text(text, file, small_language(), overrides);
}

/// All mistakes in a text, one a line; "" where it reads without any.
inline std::string mistakes_in(const std::string& text,
                               const std::vector<std::string>& overrides = {},
                               const std::string& file = "tests/a.yaml") {
  try {
    read(text, overrides, file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace gannet::test
