function text = call(command, arguments, varargin)
  % CALL  Runs a command of the program.
  %   text = myoid.call(command, arguments, 'option', value, ...)
  % arguments: cell array of the words without dashes. An option is named as on the command line, with _ for -; true
  % gives the option without a value; false and empty values leave the option out; a cell array or an array of numbers
  % gives the option several values. A series (a result of read_sto, or a table with the column time) becomes a
  % file for the call. Values of other classes are refused.
  % Returns the standard output. Raises an error with the program's own message:
  %   myoid:commandLine (exit code 2), myoid:badInput (3), myoid:failed (1), myoid:interrupted (130).
  % The codes 4 (a quality gate failed) and 5 (some trials failed) have results: they are warnings.
  if mod(numel(varargin), 2) ~= 0
    error('myoid:commandLine', 'options come in pairs of a name and a value; found %d words', numel(varargin));
  end
  words = [{command}, arguments];
  files = {};
  for k = 1:2:numel(varargin)
    [more, made] = option_words(varargin{k}, varargin{k + 1});
    words = [words, more]; %#ok<AGROW>
    files = [files, made]; %#ok<AGROW>
  end
  tidy = onCleanup(@() cellfun(@delete, files));
  line = quoted(myoid.program());
  for k = 1:numel(words)
    line = [line ' ' quoted(words{k})]; %#ok<AGROW>
  end
  log = tempname();
  [code, text] = system([line ' 2>' quoted(log)]);
  said = '';
  if exist(log, 'file')
    said = strtrim(fileread(log));
    delete(log);
  end
  switch code
    case 0
    case 4
      warning('myoid:gateFailed', '%s', ['a quality gate failed: ' said]);
    case 5
      warning('myoid:someFailed', '%s', said);
    case 2
      error('myoid:commandLine', '%s', said);
    case 3
      error('myoid:badInput', '%s', said);
    case {126, 127, 9009}  % of a shell that finds no program
      error('myoid:noProgram', ['the program %s is not found; put it into a folder of the path, or its place ' ...
                                'into the variable MYOID: setenv(''MYOID'', ''/opt/myoid/bin/myoid'')'], ...
            myoid.program());
    case 130
      error('myoid:interrupted', '%s', said);
    otherwise
      error('myoid:failed', 'exit code %d: %s', code, said);
  end
end

function [words, files] = option_words(name, value)
  % The words of one option, and the files that were made for it.
  files = {};
  if ~ischar(name) && ~(isstring(name) && isscalar(name))
    error('myoid:commandLine', 'the name of an option is a text, found a value of class %s', class(name));
  end
  words = {['--' strrep(char(name), '_', '-')]};
  if isempty(value) || (islogical(value) && isscalar(value))
    if isempty(value) || ~value
      words = {};
    end
    return
  end
  if is_series(value)
    files = {file_of(value)};
    words = [words, files];
    return
  end
  if isstring(value)
    value = cellstr(value);
  elseif isnumeric(value)
    value = num2cell(value);
  elseif ~iscell(value)
    value = {value};
  end
  for j = 1:numel(value)
    one = value{j};
    if isstring(one) && isscalar(one)
      one = char(one);
    end
    if is_series(one)
      files{end + 1} = file_of(one); %#ok<AGROW>
      words{end + 1} = files{end}; %#ok<AGROW>
    elseif isnumeric(one) && isscalar(one) && isreal(one)
      words{end + 1} = sprintf('%.17g', one); %#ok<AGROW>
    elseif ischar(one) && (isrow(one) || isempty(one))
      words{end + 1} = one; %#ok<AGROW>
    else
      error('myoid:commandLine', ['option %s: a value of class %s and size %s is not understood; expected a text, ' ...
                                  'a real number, a series, or a row or cell array of them'], ...
            char(name), class(one), mat2str(size(one)));
    end
  end
end

function answer = is_series(value)
  % A struct as read_sto returns, or a table with the column time.
  answer = (isstruct(value) && isscalar(value) && all(isfield(value, {'time', 'values', 'names'}))) || ...
           (isa(value, 'table') && any(strcmp(value.Properties.VariableNames, 'time')));
end

function file = file_of(series)
  % A storage file of a series; every number reads back to the same value.
  if isa(series, 'table')
    names = series.Properties.VariableNames;
    others = ~strcmp(names, 'time');
    series = struct('time', series.time, 'values', series{:, others}, 'names', {names(others)});
  end
  degrees = 'no';
  if isfield(series, 'in_degrees') && series.in_degrees
    degrees = 'yes';
  end
  numbers = [series.time(:), series.values];
  if numel(series.names) ~= size(series.values, 2)
    error('myoid:commandLine', 'a series has %d names for %d columns', numel(series.names), size(series.values, 2));
  end
  file = [tempname() '.sto'];
  handle = fopen(file, 'w');
  fprintf(handle, 'series\nversion=1\nnRows=%d\nnColumns=%d\ninDegrees=%s\nendheader\n', size(numbers), degrees);
  fprintf(handle, '%s\n', strjoin([{'time'}, series.names(:)'], sprintf('\t')));
  fprintf(handle, [repmat('%.17g\t', 1, size(numbers, 2) - 1) '%.17g\n'], numbers');
  fclose(handle);
end

function word = quoted(text)
  if ispc()
    if any(text == '"')
      error('myoid:commandLine', 'a word with a quote cannot be given to the program: %s', text);
    end
    word = ['"' text '"'];
  else
    word = ['''' strrep(text, '''', '''\''''') ''''];
  end
end
