"""Options that do not go together, and numbers that options cannot take, are told in plain words."""

import unittest

from support import InFolder, run


class OptionWords(InFolder):
    def setUp(self):
        super().setUp()
        rows = "\n".join(f"{0.01 * i:.2f},{3 * ((i // 20) % 2) - 1.5}" for i in range(400))
        self.record = self.write("floor.csv", "time_s,floor_acceleration_mps2\n" + rows + "\n")

    def test_numbers_that_an_option_cannot_take(self):
        for arguments, words in (
            (["motion", self.record, "--dt", "-1"], "-1 is no time step (it is above 0): give another one"),
            (["motion", self.record, "--length-scale", "0"], "0 is no scale of lengths (it lies from 0.0001 to 10000): give another one"),
            (["sensitivity", self.folder, "--total", "0"], "0 is no number of samples (it is above 0): give another one"),
            (["sensitivity", self.folder, "--confidence", "3"], "3 is no confidence (it lies from 0.5 to 0.999): give another one"),
        ):
            self.fail_with(2, arguments, words)
            self.assertLess(len(run(arguments).stderr), 300)

    def test_options_that_do_not_go_together(self):
        self.fail_with(2, ["motion", self.record, "--seed", 7], "--seed is of --synthetic")
        self.fail_with(2, ["motion", self.record, "--number", 0], "--number is of --synthetic")
        made = self.write("set.yaml", "")
        self.fail_with(2, ["motion", "--synthetic", made, "--length-scale", 0.5, "--dt", 0.01], "--dt, --length-scale goes with records")

    def test_figures_of_a_treated_record_are_no_table_of_records(self):
        table = self.folder / "figures.csv"
        self.fail_with(2, ["motion", self.record, "--baseline", "linear", "--csv", table], "--baseline changes them")
        self.assertFalse(table.exists())
        treated = self.folder / "treated.csv"
        self.succeed(["motion", self.record, "--baseline", "linear", "--convert", treated])
        self.succeed(["motion", treated, "--csv", table])

    def test_a_hazard_curve_that_is_not_there_or_a_folder(self):
        for hazard, words in ((self.folder / "no.csv", "no such file"), (self.folder, "is a folder")):
            self.fail_with(3, ["risk", self.folder, "--hazard", hazard, "-o", self.folder / "risk"], words)

    def test_tables_of_peaks(self):
        head = "specimen,motion,pta_g,mu,pulse_period_s,peak_slip_m"
        for text, words in (
            (head + "\na,b,0.6,0.2,0.9\n", "5 cells"),
            (head + "\na,b,0.6,x,0.9,0.04\n", "x"),
            (head.replace("mu,", "mu,im,") + "\na,b,0.6,0.2,2,0.9,0.04\n", "both im and mu"),
            (head.replace(",", ";") + "\na;b;0.6;0.2;0.9;0.04\n", "parted by semicolons"),
        ):
            self.fail_with(3, ["reproduce", "--peaks", self.write("peaks.csv", text), "-o", self.folder / "out"], words)


if __name__ == "__main__":
    unittest.main()
