#include "myoid/study/draft/channel_muscles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::study {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<std::string> kArm26{"TRIlong", "TRIlat", "TRImed", "BIClong", "BICshort", "BRA"};

TEST(MatchChannels, AnElectrodeStandsForAllHeadsOfItsMuscle) {
  const auto pairs = match_channels({"biceps_brachii", "Triceps.IM EMG4", "lateral_of_nothing"}, kArm26);
  EXPECT_THAT(pairs[0].muscles, ElementsAre("BIClong", "BICshort"));
  EXPECT_THAT(pairs[1].muscles, ElementsAre("TRIlong", "TRIlat", "TRImed"));
  EXPECT_THAT(pairs[2].muscles, IsEmpty());
}

TEST(MatchChannels, SeveralElectrodesOfOneMuscleTakeAHeadEach) {
  const auto pairs = match_channels({"R TRICEPS LAT", "R TRICEPS LONG", "R_BICEPS"}, kArm26);
  EXPECT_THAT(pairs[0].muscles, ElementsAre("TRIlat"));
  EXPECT_THAT(pairs[1].muscles, ElementsAre("TRIlong"));
  EXPECT_THAT(pairs[2].muscles, ElementsAre("BIClong", "BICshort"));
}

TEST(MatchChannels, BrachialisBrachioradialisAndTheBicepsOfTheThighAreThreeMuscles) {
  const auto pairs = match_channels({"brachioradialis", "Brachialis", "BicepsFemoris_R"},
                                    {"bra", "brd", "bic_l", "bic_s", "bifemlh_r"});
  EXPECT_THAT(pairs[0].muscles, ElementsAre("brd"));
  EXPECT_THAT(pairs[1].muscles, ElementsAre("bra"));
  EXPECT_THAT(pairs[2].muscles, ElementsAre("bifemlh_r"));
}

TEST(MatchChannels, SidesThatAreStatedMustAgree) {
  const auto pairs = match_channels({"soleus_l", "RightSoleus", "soleus"}, {"soleus_r", "soleus_l"});
  EXPECT_THAT(pairs[0].muscles, ElementsAre("soleus_l"));
  EXPECT_THAT(pairs[1].muscles, ElementsAre("soleus_r"));
  EXPECT_THAT(pairs[2].muscles, ElementsAre("soleus_r", "soleus_l"));
}

TEST(MatchChannels, AGroupOfMusclesIsAllOfThemAndAShortNameIsOne) {
  const std::vector<std::string> leg{"semimem_r", "semiten_r", "bifemlh_r", "bifemsh_r", "rect_fem_r",
                                     "vas_med_r", "vas_lat_r", "med_gas_r", "lat_gas_r", "soleus_r"};
  const auto pairs = match_channels({"MH", "BF", "GAS", "quadriceps", "VL", "SOL"}, leg);
  EXPECT_THAT(pairs[0].muscles, ElementsAre("semimem_r", "semiten_r"));
  EXPECT_THAT(pairs[1].muscles, ElementsAre("bifemlh_r", "bifemsh_r"));
  EXPECT_THAT(pairs[2].muscles, ElementsAre("med_gas_r", "lat_gas_r"));
  EXPECT_THAT(pairs[3].muscles, ElementsAre("rect_fem_r", "vas_med_r", "vas_lat_r"));
  EXPECT_THAT(pairs[4].muscles, ElementsAre("vas_lat_r"));
  EXPECT_THAT(pairs[5].muscles, ElementsAre("soleus_r"));
}

TEST(MatchChannels, ALetterForTheSideStandsBeforeOrBehindAnAbbreviation) {
  const std::vector<std::string> legs{"rect_fem_r", "rect_fem_l", "bifemlh_r", "vas_lat_r", "vas_lat_l", "tib_ant_r",
                                      "tib_ant_l",  "med_gas_r",  "lat_gas_r", "med_gas_l", "vas_med_l"};
  const auto one = [&](const char* channel) { return match_channels({channel}, legs)[0].muscles; };
  EXPECT_THAT(one("RRF"), ElementsAre("rect_fem_r"));
  EXPECT_THAT(one("RBF"), ElementsAre("bifemlh_r"));
  EXPECT_THAT(one("RVL"), ElementsAre("vas_lat_r"));
  EXPECT_THAT(one("RTA"), ElementsAre("tib_ant_r"));
  EXPECT_THAT(one("RGM"), ElementsAre("med_gas_r"));
  EXPECT_THAT(one("LGM"), ElementsAre("med_gas_l"));
  EXPECT_THAT(one("RT VLO"), ElementsAre("vas_lat_r"));
  EXPECT_THAT(one("LT VMO"), ElementsAre("vas_med_l"));
  EXPECT_THAT(one("LG"), ElementsAre("lat_gas_r"));  // gastrocnemius lateralis, of no side
  const auto pairs = match_channels({"TAL", "TAR"}, legs);
  EXPECT_THAT(pairs[0].muscles, ElementsAre("tib_ant_l"));
  EXPECT_THAT(pairs[1].muscles, ElementsAre("tib_ant_r"));
}

TEST(MatchChannels, ANameThatIsNoUsualOneIsComparedLetterByLetter) {
  EXPECT_THAT(match_channels({"popliteus"}, {"popliteus_r"})[0].muscles, ElementsAre("popliteus_r"));
  EXPECT_THAT(match_channels({"Voltage.1"}, {"popliteus_r"})[0].muscles, IsEmpty());
}

}  // namespace
}  // namespace myoid::study
