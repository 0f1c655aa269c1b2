#include "server/store/audit_file.hpp"

#include <fstream>

#include <gmock/gmock.h>

#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using testing::TemporaryFolder;

std::vector<AuditRow> rows_of(const std::string& client, std::uint8_t from, std::uint8_t to) {
  std::vector<AuditRow> rows;
  for (std::uint8_t k = from; k <= to; ++k) {
    rows.push_back({0, client, Blob{k}});
  }
  return rows;
}

TEST(AuditFile, TheNewestRowsComeBackInOrderAlsoWhenTheFileIsOpenedAgain) {
  const TemporaryFolder folder;
  {
    Result<AuditFile> file = AuditFile::open(folder.path());
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(file->append(rows_of("anna", 1, 5)));
  }
  Result<AuditFile> file = AuditFile::open(folder.path());
  ASSERT_TRUE(file) << file.error().message;
  const auto newest = file->newest(2);
  ASSERT_TRUE(newest) << newest.error().message;
  EXPECT_EQ(*newest, (std::vector<AuditRow>{{4, "anna", Blob{4}}, {5, "anna", Blob{5}}}));
}

TEST(AuditFile, TheOldestRowsGoBeyondTheLimit) {
  const TemporaryFolder folder;
  Result<AuditFile> file = AuditFile::open(folder.path(), 3);
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->append(rows_of("anna", 1, 2)));
  ASSERT_TRUE(file->append(rows_of("ben", 3, 5)));
  const auto all = file->newest(100);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->size(), 3U);
  EXPECT_EQ(all->front().number, 3U);
}

TEST(AuditFile, AClientIsFoundWithAllItsProgramsAndNoNamesake) {
  const TemporaryFolder folder;
  Result<AuditFile> file = AuditFile::open(folder.path());
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->append(rows_of("anna", 1, 1)));
  ASSERT_TRUE(file->append(rows_of("anna/seeker-x", 2, 2)));
  ASSERT_TRUE(file->append(rows_of("annabel", 3, 3)));
  ASSERT_TRUE(file->append(rows_of("an%", 4, 4)));
  const auto of_anna = file->newest(100, "anna");
  ASSERT_TRUE(of_anna);
  EXPECT_EQ(of_anna->size(), 2U);
  const auto of_nobody = file->newest(100, "an");
  ASSERT_TRUE(of_nobody);
  EXPECT_TRUE(of_nobody->empty());
}

TEST(AuditFile, ADamagedFileIsMovedAsideAndAnEmptyOneBegun) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "audit.db") << std::string(8192, 'x');
  Result<AuditFile> fresh = AuditFile::open(folder.path());
  ASSERT_TRUE(fresh) << fresh.error().message;
  EXPECT_NE(fresh->lost().find("was damaged"), std::string::npos) << fresh->lost();
  EXPECT_TRUE(fresh->newest(1)->empty());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "audit.db.damaged-1"));
}

}  // namespace
}  // namespace seeker::store
