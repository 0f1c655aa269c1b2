#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/drivers/p2os/p2os_params.hpp"

namespace seeker::drivers {
namespace {

using ::testing::HasSubstr;

TEST(P2osParams, TheDefaultsAreValid) { EXPECT_TRUE(validate(P2osParams{})); }

TEST(P2osParams, AValueThatCannotDriveABaseIsNamed) {
  P2osParams params;
  params.acceleration_m_s2 = 0.0;
  EXPECT_THAT(validate(params).error().message, HasSubstr("acceleration"));
  params = {};
  params.v_max_m_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(validate(params).error().message, HasSubstr("v_max"));
  params = {};
  params.sip_timeout = Duration{0};
  EXPECT_THAT(validate(params).error().message, HasSubstr("sip_timeout"));
  params = {};
  params.sync_tries = 0;
  EXPECT_THAT(validate(params).error().message, HasSubstr("sync_tries"));
}

TEST(P2osParams, ARateThatNoBaseHasIsRefused) {
  P2osParams params;
  params.bauds = {9600, 4800};
  EXPECT_FALSE(validate(params));
  params = {};
  params.switch_to_baud = 1;
  EXPECT_FALSE(validate(params));
  params = {};
  params.bauds.clear();
  EXPECT_FALSE(validate(params));
  params.serial = false;
  EXPECT_TRUE(validate(params));
}

TEST(P2osParams, AnUnknownSubclassIsRefusedWithTheKnownOnes) {
  P2osParams params;
  params.subclass = "p2";
  EXPECT_THAT(validate(params).error().message, HasSubstr("p3dx-sh"));
}

}  // namespace
}  // namespace seeker::drivers
