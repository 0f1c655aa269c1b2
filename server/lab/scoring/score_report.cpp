#include "server/lab/scoring/score_report.hpp"

#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/table.hpp"

namespace seeker::lab {

// None of these may stand in an unnamed namespace: argument-dependent look-up would not find them from Fields.
void describe(config::Fields& f, ErrorFigures& figures) {
  f.field("mean", figures.mean);
  f.field("std", figures.standard_deviation);
  f.field("median", figures.median);
  f.field("max", figures.max);
}

void describe(config::Fields& f, RelationScore& score) {
  f.field("relations", score.used);
  f.section("translation_m", score.translation_m);
  f.section("rotation_deg", score.rotation_deg);
}

void describe(config::Fields& f, RelationReport& report) {
  f.section("all", report.all);
  f.optional_section("exact", report.exact);
  f.field("missed", report.missed);
}

void describe(config::Fields& f, ReferenceReport& report) {
  f.field("poses", report.used);
  f.field("missed", report.missed);
  f.field("translation_rms_m", report.translation_rms_m);
  f.field("rotation_rms_deg", report.rotation_rms_deg);
  f.section("translation_m", report.translation_m);
  f.section("rotation_deg", report.rotation_deg);
  f.field("reference_T_map", report.reference_T_map);
}

namespace {

void add_row(Table& table, const std::string& name, const std::string& error, const ErrorFigures& f, int digits) {
  table.add({name, error, fixed(f.mean, digits), fixed(f.standard_deviation, digits), fixed(f.median, digits),
             fixed(f.max, digits)});
}

void add_rows(Table& table, const std::string& name, const RelationScore& score) {
  const std::string counted = name + " (" + std::to_string(score.used) + ")";
  add_row(table, counted, "translation m", score.translation_m, 4);
  add_row(table, counted, "rotation deg", score.rotation_deg, 2);
}

Table new_table() { return Table({"relations", "error", "mean", "std", "median", "max"}); }

}  // namespace

std::string relation_text(const RelationReport& report) {
  Table table = new_table();
  add_rows(table, "all", report.all);
  if (report.exact) {
    add_rows(table, "exact", *report.exact);
  }
  return table.text() + "missed: " + std::to_string(report.missed) + "\n";
}

std::string relation_json(const RelationReport& report) { return to_json(report); }

std::string reference_text(const ReferenceReport& report) {
  Table table({"poses", "error", "rms", "mean", "std", "median", "max"});
  const auto row = [&](const std::string& error, double rms, const ErrorFigures& f, int digits) {
    table.add({std::to_string(report.used), error, fixed(rms, digits), fixed(f.mean, digits),
               fixed(f.standard_deviation, digits), fixed(f.median, digits), fixed(f.max, digits)});
  };
  row("translation m", report.translation_rms_m, report.translation_m, 4);
  row("rotation deg", report.rotation_rms_deg, report.rotation_deg, 2);
  return table.text() + "missed: " + std::to_string(report.missed) + "\n";
}

std::string reference_json(const ReferenceReport& report) { return to_json(report); }

std::string complaints(const std::string& file, const drivers::BadLines& bad, const std::string& damage) {
  std::string text;
  if (bad.count > 0) {
    text = file + ": " + std::to_string(bad.count) + " bad lines were skipped (first: line " +
           std::to_string(bad.examples.front().number) + ", " + bad.examples.front().reason + ")";
  }
  if (!damage.empty()) {
    text += (text.empty() ? file + ": " : "; ") + std::string("the file ends early: ") + damage;
  }
  return text;
}

}  // namespace seeker::lab
