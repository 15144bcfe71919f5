function data = read_sto(file)
  % READ_STO  Reads a .sto or .mot file.
  %   data = myoid.read_sto('results/lift/ik.mot')
  % data.names: channels; data.units; data.time: n x 1 [s]; data.values: n x channels, as the file holds them;
  % data.in_degrees; data.title. In MATLAB data.table is a table with the column time first.
  variables = myoid.load_mat(file);
  data = variables.series;
  if exist('array2table', 'file') == 2 && ~exist('OCTAVE_VERSION', 'builtin')
    names = matlab.lang.makeUniqueStrings(matlab.lang.makeValidName([{'time'}, data.names]));
    data.table = array2table([data.time, data.values], 'VariableNames', names);
  end
end
