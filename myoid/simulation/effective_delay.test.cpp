#include "myoid/simulation/effective_delay.h"

#include <gtest/gtest.h>
