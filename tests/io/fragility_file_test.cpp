#include "io/fragility_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/bin_fields.hpp"
#include "io/made_fragility.hpp"
#include "io/python.hpp"
#include "io/text_files.hpp"
#include "support/error_text.hpp"
#include "support/sample_blocks.hpp"
#include "support/scratch.hpp"

namespace freestand::io {
namespace {

using fragility::BinStatus;
using test::example;

Provenance provenance() { return test::small_header().provenance; }

std::filesystem::path write_example(const test::Scratch& scratch) {
  write_fragility(scratch / "fragility.h5", provenance(), example());
  return scratch / "fragility.h5";
}

TEST(FragilityFile, OpensInH5py) {
  const test::Scratch scratch("fragility");
  FREESTAND_CHECK_WITH_PYTHON("fragility", write_example(scratch));
}
TEST(FragilityFile, OpensInXarrayByNetcdf4) {
  const test::Scratch scratch("fragility");
  FREESTAND_CHECK_WITH_PYTHON("xarray-fragility-netcdf4", write_example(scratch));
}
TEST(FragilityFile, OpensInXarrayByH5netcdf) {
  const test::Scratch scratch("fragility");
  FREESTAND_CHECK_WITH_PYTHON("xarray-fragility-h5netcdf", write_example(scratch));
}
TEST(FragilityFile, IsReadByPostprocess) {
  const test::Scratch scratch("fragility");
  write_example(scratch);
  FREESTAND_CHECK_WITH_PYTHON("postprocess", scratch.folder());
}

void expect_same(const std::vector<fragility::FragilityFunction>& a,
                 const std::vector<fragility::FragilityFunction>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (const FunctionField& field : function_fields()) {
      const double left = field.value(a[i]), right = field.value(b[i]);
      EXPECT_TRUE(left == right || (std::isnan(left) && std::isnan(right))) << field.name;
    }
    EXPECT_EQ(a[i].grid, b[i].grid);
    EXPECT_EQ(a[i].probability, b[i].probability);
    EXPECT_EQ(a[i].lower, b[i].lower);
    EXPECT_EQ(a[i].upper, b[i].upper);
    EXPECT_EQ(a[i].resampled_median, b[i].resampled_median);
    EXPECT_EQ(a[i].resampled_dispersion, b[i].resampled_dispersion);
    EXPECT_EQ(a[i].left_out_median, b[i].left_out_median);
    EXPECT_EQ(a[i].left_out_dispersion, b[i].left_out_dispersion);
  }
}

TEST(FragilityFile, ReadsBackAsItWasWritten) {
  const test::Scratch scratch("fragility");
  const fragility::Result written = example();
  const auto [from, result] = read_fragility(write_example(scratch));
  EXPECT_EQ(from.study_name, provenance().study_name);
  EXPECT_EQ(bins_csv(result), bins_csv(written));
  EXPECT_EQ(surface_csv(result), surface_csv(written));
  EXPECT_EQ(fragility_summary(from, result).dump(), fragility_summary(provenance(), written).dump());
  EXPECT_EQ(result.im_edge, written.im_edge);
  EXPECT_EQ(result.edps[1].surface.empirical_upper, written.edps[1].surface.empirical_upper);
  EXPECT_EQ(result.edps[0].surface.empirical_upper[5], written.edps[0].surface.empirical_upper[5]);
  EXPECT_EQ(result.edps[0].surface.resampled, written.edps[0].surface.resampled);
  EXPECT_EQ(result.edps[0].surface.left_out, written.edps[0].surface.left_out);
  EXPECT_EQ(result.left_out_records, 2);
  EXPECT_EQ(result.edps[0].distribution.count, written.edps[0].distribution.count);
  EXPECT_EQ(result.edps[0].axes[0].probability, written.edps[0].axes[0].probability);
  EXPECT_EQ(result.edps[0].axes[0].n, written.edps[0].axes[0].n);
  expect_same(result.edps[0].functions, written.edps[0].functions);
  expect_same({result.overturning}, {written.overturning});
}

// Sa is no intensity without its period; PGA has none.
TEST(FragilityFile, ASpectralIntensityCarriesItsPeriodAndDamping) {
  const test::Scratch scratch("fragility");
  fragility::Result sa = example();
  sa.im_name = "sa_g";
  sa.im_period_s = 0.75;
  sa.im_damping = 0.05;
  write_fragility(scratch / "sa.h5", provenance(), sa);
  const h5::Group root = h5::File::open(scratch / "sa.h5").root();
  for (const h5::Group& group : {root.open_group("overturning"), h5::File::open(scratch / "sa.h5").root()}) {
    EXPECT_EQ(group.real_attribute("im_period_s"), 0.75);
    EXPECT_EQ(group.real_attribute("im_damping"), 0.05);
  }
  // Tables and descriptions name it as `fit --im` does.
  EXPECT_THAT(surface_csv(sa), testing::HasSubstr("\nsa_g:0.75,"));
  EXPECT_THAT(surface_csv(example()), testing::HasSubstr("\npga,"));
  EXPECT_EQ(read_fragility(scratch / "sa.h5").result.im_period_s, 0.75);
  EXPECT_EQ(read_fragility(scratch / "sa.h5").result.im_damping, 0.05);
  const fragility::Result pga = read_fragility(write_example(scratch)).result;
  EXPECT_FALSE(pga.im_period_s || pga.im_damping);
  EXPECT_FALSE(h5::File::open(scratch / "fragility.h5").root().has_attribute("im_period_s"));
}

TEST(FragilityFile, AnotherFileIsRefused) {
  const test::Scratch scratch("fragility");
  h5::File::create(scratch / "x.h5").finish();
  EXPECT_THROW(read_fragility(scratch / "x.h5"), Error);
}

TEST(FragilityFile, AnEmptyResultIsAFileToo) {
  const test::Scratch scratch("fragility");
  fragility::Result nothing;
  nothing.im_edge = {0, 1};
  nothing.im = {0.5};
  write_fragility(scratch / "x.h5", provenance(), nothing);
  EXPECT_EQ(h5::File::open(scratch / "x.h5").root().open_group("edp").names().size(), 0u);
}

std::vector<std::vector<std::string>> table_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

std::string cell_of(const std::vector<std::vector<std::string>>& table, std::size_t row, const std::string& column) {
  for (std::size_t i = 0; i < table[0].size(); ++i)
    if (table[0][i] == column) return table[row][i];
  return "no column " + column;
}

TEST(BinsCsv, HasOneRowPerEdpAndBin) {
  const auto table = table_of(bins_csv(example()));
  ASSERT_EQ(table.size(), 1u + 2 * 3);
  for (const auto& row : table) EXPECT_EQ(row.size(), table[0].size());
  EXPECT_EQ(cell_of(table, 2, "edp"), "delta");
  EXPECT_EQ(cell_of(table, 2, "im_lower"), "1");
  EXPECT_EQ(cell_of(table, 2, "im_upper"), "2");
  EXPECT_EQ(cell_of(table, 2, "im"), "1.25");
  EXPECT_EQ(cell_of(table, 2, "n"), "101");
  EXPECT_EQ(cell_of(table, 2, "lambda"), "1.25");
  EXPECT_EQ(std::stod(cell_of(table, 2, "p_over")), 0.1);
  EXPECT_EQ(cell_of(table, 2, "status"), "rejected");
  EXPECT_EQ(cell_of(table, 3, "lambda"), "");
  EXPECT_EQ(cell_of(table, 3, "status"), "too_few");
  EXPECT_EQ(cell_of(table, 6, "edp"), "overturned");
}

TEST(SurfaceCsv, HasOneRowPerPointAndNamesWhatItIsOver) {
  const auto table = table_of(surface_csv(example()));
  ASSERT_EQ(table.size(), 1u + 3 * 2 + 3 * 2 * 2 + 3);
  EXPECT_EQ(table[0], (std::vector<std::string>{
                          "im_name",     "im_unit", "im",        "im_lower",   "im_upper",   "edp",        "unit",
                          "capacity",    "axis",    "axis_unit", "axis_value", "axis_lower", "axis_upper", "n",
                          "probability", "lower",   "upper",     "empirical",  "status",     "least",      "most"}));
  for (const auto& row : table) EXPECT_EQ(row.size(), table[0].size());
  EXPECT_EQ(table[4], (std::vector<std::string>{"pga", "g", "1.25", "1",     "2", "delta", "m", "2",        "",  "", "",
                                                "",    "",  "101",  "1.125", "8", "9",     "0", "rejected", "0", "0"}));
  EXPECT_EQ(cell_of(table, 5, "empirical"), "");
  EXPECT_EQ(cell_of(table, 5, "status"), "too_few");
  EXPECT_EQ(cell_of(table, 21, "edp"), "overturned");
  EXPECT_EQ(cell_of(table, 21, "capacity"), "0.5");
}

// The example's probability at [im, axis, capacity] counts on: 10 is at the third intensity, the second cell.
TEST(SurfaceCsv, HoldsTheSecondAxes) {
  fragility::Result result = example();
  result.edps[0].axes[0].probability[11] = fragility::unknown;
  const auto table = table_of(surface_csv(result));
  EXPECT_EQ(table[17], (std::vector<std::string>{"pga", "g", "3", "2", "4",  "delta", "m", "0.5", "friction_mu_k", "1",
                                                 "1.5", "1", "2", "5", "10", "1",     "2", "10",  "counts_only",   "",
                                                 ""}));
  EXPECT_EQ(cell_of(table, 18, "capacity"), "2");
  EXPECT_EQ(cell_of(table, 18, "probability"), "");
  EXPECT_EQ(cell_of(table, 18, "status"), "too_few");
}

TEST(Summary, TellsWhatASweepFound) {
  const auto json = nlohmann::json::parse(json_text(fragility_summary(provenance(), example())));
  EXPECT_EQ(json["format"], "freestand-summary/1");
  EXPECT_EQ(json["study_name"], "small");
  EXPECT_EQ(json["samples"], 21);
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["outcomes"]["not_finite"], 6);
  EXPECT_EQ(json["edps"]["delta"]["fitted"], 1);
  EXPECT_EQ(json["edps"]["delta"]["rejected"], 1);
  EXPECT_EQ(json["edps"]["delta"]["too_few"], 1);
  EXPECT_EQ(json["edps"]["delta"]["regression"]["slope"], 3.5);
  EXPECT_TRUE(json["edps"]["delta"]["regression"]["sd_slope"].is_null());
  EXPECT_EQ(json["overturning"]["median"], 1.5);
  EXPECT_TRUE(json["overturning"]["median_se"].is_null());
  EXPECT_EQ(json["overturning"]["extrapolated"], true);
  EXPECT_EQ(json["overturning"]["im_most"], 1.25);
  EXPECT_EQ(json["overturning"]["misfit"], 0.125);
  EXPECT_EQ(json["overturning"]["misfit_im"], 0.75);
  EXPECT_TRUE(json["overturning"]["misfit_p"].is_null());
  EXPECT_EQ(json["warnings"].size(), 2u);
  EXPECT_EQ(json["provenance"]["git_commit"], "abc");
}

}  // namespace
}  // namespace freestand::io
