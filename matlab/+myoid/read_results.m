function results = read_results(folder)
  % READ_RESULTS  All results of a run.
  %   r = myoid.read_results('results')
  % r.folder; r.parameters: as read_parameters; r.run: run.json (versions, inputs, stages, trials); r.trials: a struct
  % array with name, use, failure and the series that the run wrote (ik, id, activation, identified_forces,
  % StaticOptimization_force, ...), each as read_sto returns them; r.remarks; r.draws of a fit that is not exact.
  if ~exist(fullfile(folder, 'run.json'), 'file')
    error('myoid:badInput', '%s holds no run.json; give the folder of a finished run', folder);
  end
  results = myoid.load_mat(folder);
  results.folder = folder;
  results.run = jsondecode(fileread(fullfile(folder, 'run.json')));
  results.parameters = myoid.as_table(results.parameters);
end
