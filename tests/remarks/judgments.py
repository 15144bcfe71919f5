"""Which remarks on public recordings are right: code, file (a pattern), what the channel or the sentence contains (a
regular expression), whether it is right, and why. The first entry that fits a remark judges it."""

ANY = ""

JUDGED = [
    # Markers. Five jumps were looked at frame by frame, in five recordings; each is there.
    ("marker_gap", "c3d/*", "is in no frame", True, "a label of the laboratory's list without any sample"),
    ("marker_gap", "trc/*", "is in no frame", True, "the same"),
    ("marker_gap", "*", ANY, True,
     "the frames without the marker were counted in the file; it leaves the cameras' view"),
    ("marker_jump", "c3d/sample01/*", ANY, True,
     "LFT3 is 5 cm elsewhere from one frame to the next at 0.86 s; RSK1 is "
     "4 cm off in the single frame at 3.06 s"),
    ("marker_jump", "c3d/sample08/*", ANY, True, "the data of sample01"),
    ("marker_jump", "c3d/others/kinematics_tennis_serve_nan.c3d", ANY, True,
     "LWRA is 9 cm off in the single frame at 8 s"),
    ("marker_jump", "c3d/sample09/*", ANY, True, "LFEA is a center that was computed: it breaks off by 24 mm"),
    ("marker_jump", "c3d/others/duplicate_labels.c3d", ANY, True, "ELD_2 exchanges places for one frame at 6.95 s"),
    ("marker_swap", "*", ANY, True, "the labels were followed in the file"),
    ("segment_not_rigid", "examples/*", ANY, True, "skin and clothes"),
    ("marker_unit", "*", ANY, True, "the distances are those of another unit"),
    # EMG.
    ("emg_amplitude", "c3d/*", ANY, True,
     "the numbers are counts of a converter or scaled otherwise, called V in the file"),
    ("emg_envelope", "upper-limb-optical/*env*", ANY, True, "the authors say that it is an envelope"),
    ("emg_envelope", "ceinms-rt-*", ANY, True, "the authors say that it is an envelope"),
    ("emg_envelope", "gait-emg/electromyography.sto", ANY, True, "the authors say that it is processed"),
    ("emg_flat", "tables/*", ANY, True, "the made-up samples of this channel are zeros"),
    ("emg_flat", "c3d/*", ANY, True, "an input of the converter to which nothing was plugged in"),
    ("emg_flat", "*", ANY, True, "zeros in the file"),
    ("emg_clipped", "*", ANY, True, "the extreme value is repeated beyond chance"),
    ("emg_saturated", "*", ANY, True, "the extreme value lasts"),
    ("emg_crosstalk", "c3d/sample09/*", ANY, True, "inputs to which nothing was plugged in follow one disturbance"),
    ("emg_crosstalk", "upper-limb-optical/*", ANY, True, "neighboring muscles of the shoulder, a third of the power"),
    ("emg_crosstalk", "elderly-isometric/*", ANY, True,
     "a third of the power and more, at lag 0 of muscles that do not touch: a "
     "common disturbance"),
    ("emg_hum", "elderly-isometric/*", ANY, True, "lines eight times above their neighbors, at the mains"),
    ("emg_hum", "tecchio-ankle/*", ANY, True, "a relaxed muscle: the mains are most of what is left"),
    ("emg_hum", "c3d/*", ANY, True, "lines eight times above their neighbors, at the mains"),
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
    ("emg_low_signal", "c3d/*", ANY, True, "inputs to which nothing was plugged in, or numbers in another unit"),
    ("emg_low_signal", "elderly-isometric/*", "rises to only", False,
     "a muscle that rests while another works: good EMG"),
    ("emg_low_signal", "*", "rises to only", False, "a muscle that rests or works in one recording: good EMG"),
    # Plates.
    ("plate_offset", "round3/recordings/t2_zero.c3d", ANY, False, "the file names the frames to be subtracted"),
    ("plate_offset", "c3d/*", ANY, True, "the plate reads this before anybody stands on it"),
    ("plate_sign", "*", ANY, True, "the force of the file points down"),
    ("plate_pressure_outside", "c3d/others/parameterOverflow.c3d", ANY, True, "counts of a converter, not newtons"),
    # Files: notes of readers say what was read; each was compared with the file.
    ("reading", "*", ANY, True, "what the reader did with this file was compared with the file"),
    ("general", "round3/recordings/scr_q_9.c3d", "which way is up", False,
     "z is up: the screen's sign is wrong, as Qualisys writes it"),
    ("general", "*", ANY, True, "what the reader did with this file was compared with the file"),
    ("refused", "round3/recordings/scr_q_9.c3d", ANY, False,
     "z is up: the screen's sign is wrong, as Qualisys writes it"),
    ("clock_uneven", "*", ANY, True, "the intervals of the file differ"),
]  # fmt: skip
