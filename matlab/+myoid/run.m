function result = run(study, out, varargin)
  % RUN  The whole pipeline, from a study's recordings to muscle parameters.
  %   result = myoid.run('study.toml', 'results', 'overwrite', true)
  % Options are those of `myoid run --help`. Returns myoid.read_results of the folder.
  myoid.call('run', {study}, 'out', out, 'quiet', true, varargin{:});
  result = myoid.read_results(out);
end
