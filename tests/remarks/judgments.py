"""Which remarks on public recordings are right: code, file (a pattern), what the channel or the sentence contains (a
regular expression), whether it is right, and why. The first entry that fits a remark judges it.

Five marker jumps were looked at frame by frame. All other entries judge a kind of case by its sentence, its numbers and
what is known of the folder, not sample by sample ("by kind")."""

ANY = ""

JUDGED = [
    # Studies and remarks that this page met last.
    ("no_maximal_contraction", "examples/*", ANY, True, "none of these recordings holds a maximal contraction"),
    ("coordinate_absent", "examples/*", ANY, True, "the motion holds the elbow's angle alone"),
    ("model_unfit", "examples/*", ANY, True, "`run` finds the same distances, to 1 mm, in the same frames"),
    ("segment_not_rigid", "examples/elbow_emg/*", ANY, True, "the authors say that the forearm differs by session"),
    ("segment_not_rigid", "examples/upper_limb/*", ANY, False, "skin over the scapula moves so in a full abduction"),
    ("angle_jump", "ceinms-rt-leg/*", ANY, True, "single frames of inverse kinematics jump at foot strike"),
    ("angle_jump", "upper-limb-optical/*kalman*", ANY, True, "the angles of the shoulder pass their singular posture"),
    ("emg_artifact", "elderly-isometric/*", "holds the heart", False, "an electrode on the thigh hardly sees the heart"),
    ("emg_over_reference", "tables/nexus_devices.csv", ANY, False, "the file ends after 0.6 s of rest and effort"),
    ("emg_over_reference", "upper-limb-optical/*", ANY, False, "one strong movement of a muscle that rests else"),
    # Markers. Five jumps were looked at frame by frame, in four recordings; each is there.
    ("marker_gap", "c3d/*", "is in no frame", True, "a label of the laboratory's list without any sample"),
    ("marker_gap", "trc/*", "is in no frame", True, "the same"),
    ("marker_gap", "*", ANY, True,
     "by kind: a share of frames is a count; markers leave the cameras' view"),
    ("marker_jump", "c3d/sample01/*", ANY, True,
     "LFT3 is 5 cm elsewhere from one frame to the next at 0.86 s; RSK1 is "
     "4 cm off in the single frame at 3.06 s"),
    ("marker_jump", "c3d/sample08/*", ANY, True, "the data of sample01"),
    ("marker_jump", "c3d/others/kinematics_tennis_serve_nan.c3d", ANY, True,
     "LWRA is 9 cm off in the single frame at 8 s"),
    ("marker_jump", "c3d/sample09/*", ANY, True, "LFEA is a center that was computed: it breaks off by 24 mm"),
    ("marker_jump", "c3d/others/duplicate_labels.c3d", ANY, True, "ELD_2 exchanges places for one frame at 6.95 s"),
    ("clock_pause", "round3/recordings/*", ANY, True, "the file states that it pauses there"),
    # EMG.
    ("emg_amplitude", "c3d/*", ANY, True,
     "by kind: 37 V to 33 kV on skin are counts of a converter or another unit"),
    ("emg_envelope", "upper-limb-optical/*env*", ANY, True, "the authors say that it is an envelope"),
    ("emg_flat", "tables/*", ANY, True, "the made-up samples of this channel are zeros"),
    ("emg_flat", "c3d/*", ANY, True, "by kind: an input to which nothing seems to be plugged in"),
    ("emg_flat", "*", ANY, True, "zeros in the file"),
    ("emg_clipped", "*", ANY, True, "by kind: the extreme value is repeated more often than its neighbors"),
    ("emg_crosstalk", "c3d/sample09/*", ANY, True, "by kind: correlations of 0.9 among all inputs are one disturbance"),
    ("emg_crosstalk", "upper-limb-optical/*", ANY, True, "neighboring muscles of the shoulder, a third of the power"),
    ("emg_crosstalk", "elderly-isometric/*", ANY, True,
     "a third of the power and more, at lag 0 of muscles that do not touch: a "
     "common disturbance"),
    ("emg_hum", "elderly-isometric/*", ANY, True, "by kind: lines eight times above their neighbors, at the mains"),
    ("emg_hum", "tecchio-ankle/*", ANY, True, "a relaxed muscle: the mains are most of what is left"),
    ("emg_hum", "c3d/*", ANY, True, "by kind: lines eight times above their neighbors, at the mains"),
    ("emg_artifact", "tecchio-ankle/*", "movement artifact", True, "the ankle is turned, the muscle at rest"),
    ("emg_drift", "tecchio-ankle/*", ANY, True, "the ankle is turned, the muscle at rest"),
    ("emg_low_signal", "elderly-isometric/*", "^GL .*nothing but noise", True,
     "2 uV of white noise in every effort of everybody, "
     "plantarflexion too: the electrode was not connected"),
    ("emg_low_signal", "elderly-isometric/*", "nothing but noise", False,
     "the muscle rests in this effort and works in others: only the "
     "amplifier is heard"),
    ("emg_low_signal", "*", "works throughout;", True, "no rest is in the recording"),
    ("emg_low_signal", "tables/*", ANY, True, "made-up noise"),
    ("emg_low_signal", "c3d/*", ANY, True, "by kind: inputs to which nothing seems to be plugged in, or another unit"),
    ("emg_low_signal", "elderly-isometric/*", "rises to only", False,
     "a muscle that rests while another works: good EMG"),
    ("emg_low_signal", "*", "rises to only", False, "a muscle that rests or works in one recording: good EMG"),
    # Plates.
    ("plate_offset", "round3/recordings/t2_zero.c3d", ANY, False, "the file names the frames to be subtracted"),
    ("plate_offset", "c3d/*", ANY, True, "by kind: the least reading of the trial; nobody bears 10 to 60 N steadily"),
    ("plate_sign", "*", ANY, True, "the force of the file points down"),
    ("plate_pressure_outside", "c3d/others/parameterOverflow.c3d", ANY, True, "counts of a converter, not newtons"),
    # Files: notes of readers say what was read; each was compared with the file.
    ("reading", "*", ANY, True, "by kind: the reader says how it read the file"),
    ("general", "round3/recordings/scr_q_9.c3d", "which way is up", False,
     "z is up: the screen's sign is wrong, as Qualisys writes it"),
    ("general", "*", ANY, True, "by kind: the reader says how it read the file"),
    ("refused", "round3/recordings/scr_q_9.c3d", ANY, False,
     "z is up: the screen's sign is wrong, as Qualisys writes it"),
]  # fmt: skip
