//! [`View`]: the one door from 3-D to 2-D.
