#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/channel_choice.h"
#include "myoid/recording/tables/instrument_names.h"

namespace myoid::recording {
namespace {

using ::testing::ElementsAre;

TEST(NamedAsNoEmg, ForcesMomentsAndOtherInstrumentsAreAndMusclesAreNot) {
  for (const char* name : {"F1X",
                           "f3z",
                           "M2Y",
                           "Fx1",
                           "FZ",
                           "Force.Fx1",
                           "Moment.Mz2",
                           "COPx",
                           "Plate 1.Fy",
                           "FP2Fz",
                           "Fx12",
                           "Fy23",
                           "fz4",
                           "1Fx",
                           "Sync",
                           "Trigger 1",
                           "Footswitch L",
                           "LeftFootSwitch",
                           "Right Footswitch",
                           "RightGonio",
                           "Sensor 1: ACC.X 1",
                           "EMG 01 (5471) GYRO Y",
                           "FSR adapter 9: FSR.A 9",
                           "Sensor 4: EKG 4",
                           "ECG"})
    EXPECT_TRUE(named_as_no_emg(name)) << name;
  for (const char* name : {"SOL",        "TA",          "BIC",      "Flexor carpi", "MG",       "M1",        "F8",
                           "Max",        "FDS",         "PL",       "Voltage.1",    "Soleus_R", "Mylohyoid", "EMG 3",
                           "Temporalis", "Acc. flexor", "LeftFoot", "LeftTA",       "right",    ""})
    EXPECT_FALSE(named_as_no_emg(name)) << name;
}

TEST(NamedAsInput, SpareInputsAreAndEmgIsNot) {
  for (const char* name : {"Analog 13", "Sensor 13: Analog 13", "aux2", "AUX"})
    EXPECT_TRUE(named_as_input(name)) << name;
  for (const char* name : {"EMG 1", "EMG Analog 3", "BIC", "Auxetic", "Voltage.1", ""})
    EXPECT_FALSE(named_as_input(name)) << name;
}

TEST(EmgChannels, NeedVoltsAndNoPlate) {
  const std::vector<Channel> channels{{"Voltage.1", Unit::volt},
                                      {"Voltage.2", Unit::volt},
                                      {"Fz1", Unit::volt},
                                      {"Elbow", Unit::radian},
                                      {"BIC", Unit::volt}};
  EXPECT_THAT(emg_channels(channels, {}), ElementsAre("Voltage.1", "Voltage.2", "BIC"));
  PlateSetup plate;
  plate.channels = {1, 2, 99};
  EXPECT_THAT(emg_channels(channels, {plate}), ElementsAre("Voltage.1", "BIC"));
}

}  // namespace
}  // namespace myoid::recording
