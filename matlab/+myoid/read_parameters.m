function parameters = read_parameters(results)
  % READ_PARAMETERS  The identified parameters of a run.
  %   p = myoid.read_parameters('results')
  % results: the folder, or its parameters.csv. Returns the table of parameters.csv: a row for each muscle, parameter,
  % method and case, with estimate, ci_low, ci_high (95 %), verdict and reason. In Octave, which has no tables, a
  % struct with a field for each column: numbers as n x 1 (NaN where there is none), texts as cell arrays.
  file = results;
  if exist(results, 'dir')
    file = fullfile(results, 'parameters.csv');
  end
  variables = myoid.load_mat(file);
  parameters = myoid.as_table(variables.parameters);
end
